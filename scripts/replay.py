"""Front of ``python -m signimit replay``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["replay", *sys.argv[1:]])
