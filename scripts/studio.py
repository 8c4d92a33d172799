"""Front of ``python -m signimit studio``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["studio", *sys.argv[1:]])
