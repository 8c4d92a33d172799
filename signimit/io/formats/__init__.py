"""Other people's formats: strokes as UNIPEN text, $1 recogniser XML and W3C InkML, demonstrations as CSV tables."""

from signimit.io.formats.csv_demonstrations import read_csv_demonstrations as read_csv_demonstrations
from signimit.io.formats.csv_demonstrations import write_csv_demonstrations as write_csv_demonstrations
from signimit.io.formats.detection import detect_format as detect_format
from signimit.io.formats.dollar import read_dollar as read_dollar
from signimit.io.formats.import_report import ImportReport as ImportReport
from signimit.io.formats.import_report import StrokeImportWarning as StrokeImportWarning
from signimit.io.formats.inkml import read_inkml as read_inkml
from signimit.io.formats.inkml import write_inkml as write_inkml
from signimit.io.formats.reading import READERS as READERS
from signimit.io.formats.reading import import_strokes as import_strokes
from signimit.io.formats.reading import inventory_table as inventory_table
from signimit.io.formats.reading import read_strokes as read_strokes
from signimit.io.formats.unipen import read_unipen as read_unipen
