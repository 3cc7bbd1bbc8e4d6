"""Takes a picture of a page with a headless browser."""
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from ..errors import DrawError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge")
SECONDS = 120
MILLISECONDS = 10_000  # of the page's virtual time, in which everything is drawn


def take_still(text, path, size):
    """Writes a picture of the page `text` as PNG of `size` pixels. Returns the path."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        raise DrawError(f"--png needs one of {', '.join(BROWSERS)}, and none is installed (Debian: apt install "
                        "chromium); `draw frame` draws a picture without a browser")
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder) / "view.html", Path(folder) / "view.png"
        page.write_text(text, encoding="utf-8")
        command = [browser, "--headless", *(["--no-sandbox"] if os.geteuid() == 0 else []), "--hide-scrollbars", "--use-angle=swiftshader",
                   "--enable-unsafe-swiftshader", f"--user-data-dir={folder}/profile",
                   f"--virtual-time-budget={MILLISECONDS}", f"--window-size={size[0]},{size[1]}",
                   f"--screenshot={picture}", page.as_uri()]
        try:
            ended = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
        except subprocess.TimeoutExpired:
            raise DrawError(f"{browser} took more than {SECONDS} s to draw the view") from None
        if not picture.is_file():
            last = (ended.stderr.strip().splitlines() or ["no message"])[-1]
            raise DrawError(f"{browser} drew no picture: {last}")
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(picture, path)
    return path
