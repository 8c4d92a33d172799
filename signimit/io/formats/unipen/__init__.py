"""UNIPEN 1.0 text: what a pen wrote, and the segments, of any level, that say what the parts of it are.

Format: I. Guyon et al., UNIPEN project of on-line data exchange and recognizer benchmarks, ICPR 1994
(doi:10.1109/ICPR.1994.576870), in the reading of its reference library, uptools3. `statements` finds keywords and
follows ``.INCLUDE``, `pen_data` reads what the pen did, `segments` what is written about it; `drawings` joins them.
"""

from signimit.io.formats.unipen.drawings import parse_unipen as parse_unipen
from signimit.io.formats.unipen.drawings import read_unipen as read_unipen
from signimit.io.formats.unipen.statements import is_unipen as is_unipen
