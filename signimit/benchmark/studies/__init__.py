"""Studies behind the command `study`: learners and baselines, policies, signs and confidences compared on equal terms.

The baselines need scikit-learn (the extra ``study``), the figures matplotlib (``scripts``).
"""
