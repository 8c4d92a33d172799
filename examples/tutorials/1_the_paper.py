"""
The paper in ten steps
======================

Text.
"""

import signimit as si

# %%
# One
print(si.PAPER_LANGUAGE)
