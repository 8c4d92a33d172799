"""Front of ``python -m signimit record``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["record", *sys.argv[1:]])
