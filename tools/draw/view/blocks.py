"""Arrays as text in an HTML page: quantised, compressed by gzip, in base64.

The reader is web/src/blocks.ts. Numbers are little-endian. The values are sorted by component, because
this order compresses better. Kinds:
  u32     unsigned integers
  f32     single precision
  linear  uint16 between the smallest and the largest value of each component; error: 8e-6 of the difference of the two
  half    half precision times a factor, plus an offset; error: 5e-4 of the difference from the offset; keeps NaN
"""
import base64
import gzip
import hashlib
import html
import json
import math

import numpy as np

LEVELS = 65535
LARGEST_HALF = 32768.0


class Blocks:
    """Script elements, one for each named array. An array that equals an earlier one only refers to that one."""

    def __init__(self):
        self._elements, self._known = [], {}

    def add(self, name, kind, values, offset=0.0):
        values = np.asarray(values) - offset if offset else np.asarray(values)
        planes = np.ascontiguousarray(values.reshape(len(values), math.prod(values.shape[1:])).T)
        raw, numbers = ENCODERS[kind](planes)
        same = self._known.setdefault((kind, offset, planes.shape, json.dumps(numbers), hashlib.sha256(raw).digest()), name)
        if same != name:
            self._elements.append(f'<script type="application/octet-stream" id="{html.escape(name)}" '
                                  f'data-same="{html.escape(same)}"></script>')
            return
        packed = base64.b64encode(gzip.compress(raw, 6, mtime=0)).decode()
        about = html.escape(json.dumps({"kind": kind, "components": len(planes), **numbers, **({"offset": offset} if offset else {})}))
        self._elements.append(f'<script type="application/octet-stream" id="{html.escape(name)}" data-about="{about}">'
                              f"{packed}</script>")

    def text(self):
        return "\n".join(self._elements)


def _linear(planes):
    low = np.min(planes, axis=1, initial=np.inf, where=np.isfinite(planes))
    high = np.max(planes, axis=1, initial=-np.inf, where=np.isfinite(planes))
    low, high = np.where(low <= high, low, 0.0), np.where(low <= high, high, 0.0)
    step = (high - low) / LEVELS
    scaled = (planes - low[:, None]) / np.where(step > 0, step, 1)[:, None]
    levels = np.rint(np.clip(np.nan_to_num(scaled, nan=0), 0, LEVELS)).astype("<u2")
    return levels.tobytes(), {"low": low.tolist(), "step": step.tolist()}


def _half(planes):
    finite = np.abs(planes[np.isfinite(planes)])
    largest = float(finite.max()) if finite.size else 0.0
    factor = largest / LARGEST_HALF if largest > 0 else 1.0
    return (planes.astype(np.float64) / factor).astype("<f2").tobytes(), {"factor": factor}


ENCODERS = {"u32": lambda planes: (planes.astype("<u4").tobytes(), {}),
            "f32": lambda planes: (planes.astype("<f4").tobytes(), {}),
            "linear": _linear, "half": _half}
