"""Front of ``python -m signimit results readme``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["results", "readme", *sys.argv[1:]])
