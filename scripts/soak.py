"""Front of ``python -m signimit soak``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["soak", *sys.argv[1:]])
