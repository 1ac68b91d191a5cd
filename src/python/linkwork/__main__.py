"""``python -m linkwork``: the command line."""

import sys

from . import _command

sys.argv[0] = "linkwork"
_command()
