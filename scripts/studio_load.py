"""Front of ``python -m signimit studio-load``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["studio-load", *sys.argv[1:]])
