"""Front of ``python -m signimit learn``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["learn", *sys.argv[1:]])
