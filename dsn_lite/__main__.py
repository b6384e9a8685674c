"""The command line: python -m dsn_lite collect | train | evaluate | axioms | deform | transfer | edit | zoo | ..."""

import sys
from collections.abc import Sequence

import tyro

from .commands import COMMANDS


def main(args: Sequence[str] | None = None) -> int:
    """Run a command; trouble becomes one sentence on stderr and 2 is returned, 130 after Ctrl-C, or its own code."""
    try:
        code = tyro.extras.subcommand_cli_from_dict(
            COMMANDS, prog="python -m dsn_lite", description="Deformation spaces: train, measure, use.", args=args
        )
    except (ValueError, OSError, FloatingPointError, ImportError) as trouble:
        print(trouble, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return 130
    return code or 0


if __name__ == "__main__":
    sys.exit(main())
