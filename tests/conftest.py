"""What every test stands on: one thread, and the same drawn examples on every machine."""

import hypothesis
import torch

torch.set_num_threads(1)  # small tensors: a second thread costs more than it brings
hypothesis.settings.register_profile("ci", max_examples=25, derandomize=True, deadline=None, database=None)
hypothesis.settings.register_profile("explore", max_examples=500, deadline=None)
hypothesis.settings.load_profile("ci")
