"""The digest of the script's sources, which the bundle of them begins with: `python3 bundle.py` writes that line.

To make the bundle again, in web/:  npm ci && npm run check && npm run bundle
"""
import hashlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
LICENCE = HERE / "web" / "THREE_LICENSE"


def digest():
    """Of all sources and of the versions they are bundled with."""
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
