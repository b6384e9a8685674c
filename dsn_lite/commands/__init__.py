"""The commands of python -m dsn_lite, one function each."""

from .carrying import collect, deform, transfer
from .editing import edit
from .measuring import evaluate, report_axioms, reproduce
from .shipping import build, show_zoo
from .training import sweep, train

COMMANDS = {
    "collect": collect,
    "train": train,
    "sweep": sweep,
    "evaluate": evaluate,
    "axioms": report_axioms,
    "deform": deform,
    "transfer": transfer,
    "edit": edit,
    "zoo": show_zoo,
    "reproduce": reproduce,
    "build": build,
}
