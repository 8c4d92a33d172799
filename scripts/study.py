"""Front of ``python -m signimit study``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["study", *sys.argv[1:]])
