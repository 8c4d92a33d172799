"""Front of ``python -m signimit train``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["train", *sys.argv[1:]])
