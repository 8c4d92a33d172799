"""W3C InkML 1.1, the Ink Markup Language (Recommendation of 20 September 2011, https://www.w3.org/TR/InkML)."""

from signimit.io.formats.inkml.reading import parse_inkml as parse_inkml
from signimit.io.formats.inkml.reading import read_inkml as read_inkml
from signimit.io.formats.inkml.writing import write_inkml as write_inkml
