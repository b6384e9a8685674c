"""Commands of this package and of data_gen, which it does not import: each in a process of its own."""

import subprocess
import sys


def python(where: str, *arguments: object) -> None:
    """Runs python with these arguments; what it says, progress bars too, goes where this process writes.

    Raises ValueError where it does not end well; `where` asked for it.
    """
    told = [*map(str, arguments)]
    if code := subprocess.run([sys.executable, *told], check=False).returncode:
        raise ValueError(
            f"{where}: python {' '.join(told)} must end well, got exit code {code}; see what it said above, and repeat"
        )
