"""The table of what is in a library."""

import numpy as np

from signimit import Stroke, StrokeLibrary
from signimit.io.formats import inventory_table


def test_labels_are_rows_and_writers_columns_in_the_order_people_count() -> None:
    stroke = Stroke(np.array([(0, 0), (1, 1.0)]), np.array([0, 1.0]))
    library = StrokeLibrary((stroke,) * 4, ("star", "4", "star", "star"), ("13", "2", "2", "2"))
    assert inventory_table(library) == "label  2  13\n    4  1   0\n star  2   1"
