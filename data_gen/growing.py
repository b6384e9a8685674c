"""Arrays in files that grow row by row, so that they need not fit in memory."""

import numpy as np


class Growing:
    """An .npy file that grows row by row: numpy leaves room in its header for the number of rows."""

    def __init__(self, path):
        self.file, self.rows, self.kind = path.open("wb"), 0, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with self.file:
            self._head()

    def append(self, rows):
        """Write rows (M, ...) at the end."""
        if self.kind is None:
            self.kind = {"descr": rows.dtype.str, "fortran_order": False, "shape": rows.shape}
            self._head()
        self.rows += len(rows)
        self.file.write(rows)

    def _head(self):
        self.file.seek(0)
        if self.kind is not None:
            shape = (self.rows, *self.kind["shape"][1:])
            np.lib.format.write_array_header_1_0(self.file, {**self.kind, "shape": shape})
