#!/usr/bin/env python3
"""Draw plots/explorer.png, the README's picture of the interactive explorer: its page in a browser.

    explorer_picture.py --prefix FOLDER [-o FILE.png]

FOLDER is where faststrip is installed (`./run install --prefix FOLDER`); the browser is chromium,
without a screen. Bokeh and selenium come from tools/requirements-explore.txt.
"""

import argparse
import base64
import io
import os
import pathlib
import sys
import tempfile

from PIL import Image  # comes with matplotlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools" / "measure"))
from page_in_browser import Served, start_browser  # noqa: E402

# Two-point contact: tread and flange root.
CASE = """&contact load_N = 80000.0, shift_mm = 5.0 /
&wheel profile = 's1002' /
&rail profile = '60e1' /
&material mu = 0.3 /
&motion cksi = 0.001, ceta = 0.0, cphi_rad_per_mm = 2.0e-4 /
"""
COLORS = 96  # of the picture, which stays small
READY = ("const [done] = arguments; const look = () => "
         "window.Bokeh?.is_spared ? setTimeout(done, 2000) : setTimeout(look, 50); look()")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("-o", dest="output", default=str(ROOT / "plots" / "explorer.png"))
    options = parser.parse_args()
    environment = {**os.environ, "FASTSTRIP_PREFIX": str(options.prefix),
                   "PYTHONPATH": str(ROOT / "python"), "OPENBLAS_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "case.nml").write_text(CASE, encoding="utf-8")
        served = Served(environment, folder, "--case", "case.nml")
        browser = start_browser()
        try:
            browser.get(served.address)
            browser.execute_async_script(READY)
            shot = browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
        finally:
            browser.quit()
            served.end()
    with Image.open(io.BytesIO(base64.b64decode(shot))) as picture:
        few = picture.convert("RGB").quantize(COLORS, dither=Image.Dither.NONE)
        few.save(options.output, optimize=True)


if __name__ == "__main__":
    main()
