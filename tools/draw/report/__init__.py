"""One page and paper figures from compare.json, what `orthodyn compare` has written."""
