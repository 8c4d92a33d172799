"""Front of ``python -m signimit timing``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["timing", *sys.argv[1:]])
