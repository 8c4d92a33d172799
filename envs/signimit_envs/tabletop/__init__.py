"""The tabletop environment, one part of a Gymnasium environment a module.

==================== ============================================================================
``env``              `TabletopEnv`
``actions``          ``control="joint"`` and ``control="hand"``
``observations``     ``obs_type="state"``, ``"pixels"`` and ``"state_pixels"``; ``sign_cards`` draws the signs
``rewards``          ``reward="sparse"`` and ``"dense"``
``success``          whether the request is fulfilled
``reset_options``    the start of an episode
``language_options`` the language, and ``people`` the signer and the mover who speak it
==================== ============================================================================
"""

from signimit_envs.tabletop.env import TabletopEnv as TabletopEnv
