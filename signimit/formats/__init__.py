"""Other people's formats: strokes as UNIPEN text, $1 recogniser XML and W3C InkML, demonstrations as CSV tables."""

from signimit.formats.csv_demonstrations import read_csv_demonstrations as read_csv_demonstrations
from signimit.formats.csv_demonstrations import write_csv_demonstrations as write_csv_demonstrations
from signimit.formats.dollar import read_dollar as read_dollar
from signimit.formats.inkml import read_inkml as read_inkml
from signimit.formats.inkml_writer import write_inkml as write_inkml
from signimit.formats.inventory import inventory_table as inventory_table
from signimit.formats.reading import READERS as READERS
from signimit.formats.reading import detect_format as detect_format
from signimit.formats.reading import read_strokes as read_strokes
from signimit.formats.unipen import read_unipen as read_unipen
