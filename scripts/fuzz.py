"""Front of ``python -m signimit fuzz``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["fuzz", *sys.argv[1:]])
