"""How many reproductions a second, and what they cost: ratios within one run, so that any machine may repeat them.

================== =================================================================================================
module             what
================== =================================================================================================
``work``           the reproductions that are timed
``batches``        many at once against one at a time, and whether they are the same
``parts``          the parts of a control step
``vector_envs``    Gymnasium's ways to step several environments
``report``         all of it as JSON and as Markdown
================== =================================================================================================
"""
