"""Orthographic view from a direction, given by azimuth and elevation in degrees relative to the up axis."""
import numpy as np


# Rotations that turn this axis to z.
TURNS = {"x": np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]]), "y": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
         "z": np.eye(3)}


class Camera:
    def __init__(self, azimuth=-60.0, elevation=20.0, up="z"):
        a, e = np.radians([azimuth, elevation])
        self.right = np.array([-np.sin(a), np.cos(a), 0.0])
        self.toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self.up = np.cross(self.toward, self.right)
        self.right, self.toward, self.up = (axis @ TURNS[up] for axis in (self.right, self.toward, self.up))
        light = -0.45 * self.right + 0.62 * self.up + 0.80 * self.toward
        self.light = light / np.linalg.norm(light)

    def flat(self, points):
        """Picture coordinates (..., 2)."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        """Depth; larger is nearer to the eye."""
        return points @ self.toward

    def shade(self, normals):
        """Lambert shading between 0.6 and 1, with ambient light."""
        lambert = np.clip(normals @ self.light, 0, 1)
        sky = 0.5 * (1 + normals @ self.up)
        return np.clip(0.60 + 0.32 * lambert + 0.08 * sky, 0, 1)


class Window:
    """The rectangle in the picture plane that bounds everything passed to `include`."""

    def __init__(self):
        self.low, self.high = np.full(2, np.inf), np.full(2, -np.inf)

    def include(self, flat):
        self.low = np.minimum(self.low, flat.min(axis=0))
        self.high = np.maximum(self.high, flat.max(axis=0))

    @property
    def size(self):
        size = self.high - self.low
        return np.maximum(size, 1e-3 * max(size.max(), 1e-9))

    def fitted(self, width, height, margin=0.025):
        """(xlim, ylim) around the rectangle, with the aspect ratio width:height."""
        scale = (1 + 2 * margin) * max(self.size[0] / width, self.size[1] / height)
        middle, half = (self.low + self.high) / 2, scale * np.array([width, height]) / 2
        return [(middle[i] - half[i], middle[i] + half[i]) for i in range(2)]
