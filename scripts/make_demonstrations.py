"""Front of ``python -m signimit make-demonstrations``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["make-demonstrations", *sys.argv[1:]])
