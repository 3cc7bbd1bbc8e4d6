"""HTML pages with a 3D view: `draw view`. Knows runs and modes; studies provide their own sources."""
