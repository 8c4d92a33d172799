"""The default learner: movements, foci, word order and sign meanings inferred together."""
