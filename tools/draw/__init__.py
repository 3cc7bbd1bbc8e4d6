"""Draws the results of orthodyn: pictures, animations, curves, reports and 3D views."""
