"""Entry of `make bench`: the comparison, with the arguments of `python -m righting_bench compare`."""

import sys

from righting_bench.__main__ import main

if __name__ == "__main__":
    sys.exit(main(["compare", *sys.argv[1:]]))
