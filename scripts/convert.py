"""Front of ``python -m signimit convert``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["convert", *sys.argv[1:]])
