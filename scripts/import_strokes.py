"""Front of ``python -m signimit import-strokes``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["import-strokes", *sys.argv[1:]])
