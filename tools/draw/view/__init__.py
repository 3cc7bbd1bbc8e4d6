"""Results as one HTML file with a 3D view that opens offline: `draw view`."""
