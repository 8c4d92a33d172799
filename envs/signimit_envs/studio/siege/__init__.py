"""A siege of the studio: requests and frames that no page would send, and a look at what they did.

`signimit_envs.studio.siege.siege` runs it, the other modules make what is sent and watch the server.
"""
