"""Draws what `orthodyn run` has written: pictures of frames, strips, animations and curves."""
