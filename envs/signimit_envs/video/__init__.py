"""Pictures and films of the scene.

================== =========================================================================
``backend``        which OpenGL backend works
``rendering``      `OffscreenView`: pictures by OpenGL
``window``         `WindowView`: MuJoCo's viewer, where a display opens one
``storyboard``     `Shot`: what each frame of a film of a session shows, not drawn yet
``scene_renderer`` `SceneRenderer`: the scene of a shot, with trails and hands
``overlays``       captions, cards and signs
``films``          `Film`: the frames of a session's film
``mp4``            video files
``record_mp4``     `RecordMp4`: a Gymnasium wrapper that films episodes
================== =========================================================================
"""
