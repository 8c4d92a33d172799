"""Front of ``python -m signimit reproduce``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["reproduce", *sys.argv[1:]])
