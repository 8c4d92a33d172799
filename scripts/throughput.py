"""Front of ``python -m signimit throughput``."""

import sys

from signimit.__main__ import main

if __name__ == "__main__":
    main(["throughput", *sys.argv[1:]])
