"""Pictures and films of the scene.

================== =========================================================================
``rendering``      OpenGL: which backend works, `OffscreenView` and `WindowView`
``storyboard``     `Shot`: what each frame of a film of a session shows, not drawn yet
``scene_renderer`` `SceneRenderer`: the scene of a shot, with trails and hands
``overlays``       captions, cards and signs
``films``          `Film`: the frames of a session's film
``mp4``            video files
``record_mp4``     `RecordMp4`: a Gymnasium wrapper that films episodes
================== =========================================================================
"""
