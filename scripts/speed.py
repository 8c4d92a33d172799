"""Front of ``python -m signimit speed``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["speed", *sys.argv[1:]])
