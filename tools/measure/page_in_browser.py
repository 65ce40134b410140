#!/usr/bin/env python3
"""The page of faststrip-explore served, and a browser without a screen that shows it: for its test
and for tools/measure/bench_page.py. By itself it takes the picture of the README:

    page_in_browser.py --prefix FOLDER [-o FILE.png]

FOLDER is where faststrip is installed; FILE.png is plots/explorer.png unless said. It takes Pillow.
"""

import argparse
import io
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BROWSER, DRIVER = (shutil.which(name) for name in ("chromium", "chromedriver"))
WIDTH, HEIGHT = 1280, 720
# What the picture shows: a wheelset in a curve, of which all has come and been drawn after that, s.
SHOWN, COLOURS, SETTLED = {"shift": 5.5, "yaw": 3.0, "curvature": 2.0, "load": 90.0}, 64, 6
# Long enough for a machine ten times slower, s.
PATIENCE = 120


class Served:
    """A page that is served until `end`."""

    def __init__(self, environment, folder, *words):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "faststrip.explore", "--no-browser", "--port", "0", *words],
            cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            encoding="utf-8", env=environment)
        line = self.process.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:\d+/", line)
        if found is None:
            raise RuntimeError(f"no page: {line}{self.process.communicate()[1]}")
        self.address = found[0]
        self.port = int(self.address.rsplit(":", 1)[1].strip("/"))

    def end(self):
        """Ctrl-C; the exit code and what was said on stderr."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        said = self.process.communicate(timeout=PATIENCE)[1]
        return self.process.returncode, said


def start_browser(downloads=None):
    """A chromium of 1280 x 720 pixels that draws with the processor alone."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--hide-scrollbars"):
        options.add_argument(word)
    if downloads is not None:
        options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options, webdriver.ChromeService(DRIVER))
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False})
    browser.set_script_timeout(PATIENCE)
    return browser


def main():
    from PIL import Image, ImageOps

    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("-o", dest="output", default=str(ROOT / "plots" / "explorer.png"))
    options = parser.parse_args()
    served = Served({**os.environ, "FASTSTRIP_PREFIX": str(options.prefix),
                     "PYTHONPATH": str(ROOT / "python")}, ROOT)
    browser = start_browser()
    try:
        browser.get(served.address)
        browser.execute_async_script(
            "const [done] = arguments; const look = () => window.Bokeh?.is_spared"
            " ? done() : setTimeout(look, 50); look()")
        browser.execute_script("""
            const of = (name) => Bokeh.documents[0].get_model_by_name(name)
            of('view').active = 1
            for (const [name, value] of Object.entries(arguments[0])) of(name).value = value
            """, SHOWN)
        time.sleep(SETTLED)
        picture = Image.open(io.BytesIO(browser.get_screenshot_as_png())).convert("RGB")
    finally:
        browser.quit()
        served.end()
    _, _, right, bottom = ImageOps.invert(picture).getbbox()
    picture = picture.crop((0, 0, right + 8, bottom + 8)).quantize(COLOURS)
    picture.save(options.output, optimize=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
