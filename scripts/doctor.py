"""Front of ``python -m signimit doctor``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["doctor", *sys.argv[1:]])
