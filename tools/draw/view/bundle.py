"""Writes the digest of the TypeScript sources into the first line of viewer.js: `python3 bundle.py`.

To build viewer.js, in web/:  npm ci && npm run check && npm run bundle
"""
import hashlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
LICENCE = HERE / "web" / "THREE_LICENSE"


def digest():
    """The digest of all sources and package versions."""
    found = hashlib.sha256()
    for path in sorted((HERE / "web" / "src").glob("*.ts")) + [HERE / "web" / "package.json"]:
        found.update(path.name.encode() + path.read_bytes())
    return found.hexdigest()[:32]


def stamp():
    bundle = HERE / "viewer.js"
    licence = LICENCE.read_text(encoding="utf-8").strip()
    bundle.write_text(f"/* sources {digest()}\nwith three.js:\n{licence}\n*/\n{bundle.read_text(encoding='utf-8')}",
                      encoding="utf-8")


if __name__ == "__main__":
    stamp()
