"""Learners and baselines on the same sessions: cells, methods, records, tables. For the command `study`, not for users.

The baselines need scikit-learn (the extra ``study``), the figures matplotlib (``scripts``).
"""
