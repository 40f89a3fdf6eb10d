"""The program `hairline`, the same as the one that cargo builds."""

import signal
import sys
from typing import NoReturn

from . import _hairline


def main() -> NoReturn:
    """Runs it on this process's arguments and exits with its code."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it, as any program
    sys.exit(_hairline.run(["hairline", *sys.argv[1:]], [sys.executable, "-m", "hairline"]))
