#!/usr/bin/env python3
"""Time from the move of a slider of faststrip-explore to the picture that shows it, in a browser.

    bench_page.py --prefix FOLDER [-o FILE.csv] [--moves N]

FOLDER is where faststrip is installed. Chromium without a screen draws with the processor alone: a
graphics card is left out of it. Each slider makes N moves (default 60), each after the picture of
the one before has stood still for a while and what takes longer has come: creep curve, sweep, map
and contact functions, which wait until the sliders rest, and do not count here. The last row is a
shift in the wheelset's view.

CSV: slider,moves and, in ms, median and 95th percentile of
    arrived    from the slider's event to the message with its changes in the browser: both ways
               over the wire, the solution and what the server makes of it
    drawn      to the end of the last drawing on a canvas
    painted    to the first frame of the browser after that (requestAnimationFrame): what is seen
"""

import argparse
import csv
import importlib.metadata
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile

from page_in_browser import BROWSER, Served, start_browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ("arrived", "drawn", "painted")
# What is wrapped once: the drawing of each figure. Frames are listed all the time.
WATCH = """
const done = arguments[arguments.length - 1]
const seen = window.seen = {frames: [], drawn: [], arrived: []}
const plot = Bokeh.require('models/plots/plot_canvas').PlotView.prototype
const name = ['_actual_paint', 'actual_paint', 'paint'].find((one) => one in plot)
const paint = plot[name]
plot[name] = function(...words) {
  const start = performance.now()
  const answer = paint.apply(this, words)
  seen.drawn.push([start, performance.now()])
  return answer
}
const wire = Bokeh.documents[0].get_model_by_name('wire')
wire.properties.text.change.connect(() => seen.arrived.push(performance.now()))
const frame = () => { seen.frames.push(performance.now()); requestAnimationFrame(frame) }
requestAnimationFrame(frame)
setTimeout(() => done(name), 100)
"""
# One move; it is over when nothing has been drawn for a while.
MOVE = """
const [name, value, still, done] = arguments
for (const list of Object.values(seen)) list.length = 0
const start = performance.now()
Bokeh.documents[0].get_model_by_name(name).value = value
const end = () => {
  // What arrives before anything is drawn is a part of the same change.
  const until = seen.arrived.find((one) => one > seen.drawn[0]?.[0]) ?? Infinity
  const last = seen.drawn.findLast(([_, drawn]) => drawn < until)?.[1]
  const known = last != null && seen.arrived.length > 0 && seen.frames.some((one) => one > last)
  if (!known || performance.now() - last < still) { setTimeout(end, 20); return }
  done([seen.arrived[0] - start, last - start,
        seen.frames.find((one) => one > last) - start, seen.drawn.length,
        seen.drawn.reduce((sum, [a, b]) => sum + b - a, 0)])
}
setTimeout(end, 20)
"""
STILL, QUIET = 150, 400  # ms: without a drawing, without a message
# Until what takes longer has come.
REST = """
const [quiet, done] = arguments
const start = performance.now()
const end = () => {
  const rests = performance.now() - Math.max(start, seen.arrived.at(-1) ?? 0) > quiet
  setTimeout(rests ? done : end, 20)
}
end()
"""
WHEELSET = "wheelset"
# Sliders, where they begin, and their steps.
SLIDERS = (("shift", 0.0, 0.1), ("yaw", 1.0, 0.5), ("load", 100.0, 1.0), ("cksi", 0.1, 0.01),
           ("cphi", 0.05, 0.005), ("mu", 0.3, 0.01), (WHEELSET, 0.0, 0.1))


def measure(browser, slider, begin, step, moves):
    """Times of the moves of a slider, ms; of the displacement in the wheelset's view."""
    rows = []
    if slider == WHEELSET:
        browser.execute_script("Bokeh.documents[0].get_model_by_name('view').active = 1")
        browser.execute_async_script(REST, 5 * QUIET)
        slider = "shift"
    for k in range(moves + 3):
        value = round(begin + step * (1 + k % 10), 6)
        rows.append(browser.execute_async_script(MOVE, slider, value, STILL))
        browser.execute_async_script(REST, QUIET)
    browser.execute_async_script(MOVE, slider, begin, STILL)
    return rows[3:]  # the first ones warm up


def p95(values):
    return statistics.quantiles(values, n=20, method="inclusive")[-1]


def stamps(prefix):
    """What was measured, and where."""
    def said(*words):
        return subprocess.run(words, stdout=subprocess.PIPE, encoding="utf-8",
                              check=True).stdout.strip()

    cpu = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text("utf-8"),
                    re.MULTILINE)
    return (said(prefix / "bin" / "faststrip", "--version").splitlines()[0],
            f"processor {cpu[1] if cpu else platform.machine()}",
            f"Bokeh {importlib.metadata.version('bokeh')}, {said(BROWSER, '--version')}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("-o", dest="output", default=str(ROOT / "out" / "page.csv"),
                        metavar="FILE.csv", help="table (default out/page.csv)")
    parser.add_argument("--moves", type=int, default=60)
    options = parser.parse_args()
    environment = {**os.environ, "FASTSTRIP_PREFIX": str(options.prefix),
                   "PYTHONPATH": str(ROOT / "python"), "OPENBLAS_NUM_THREADS": "1"}
    table = []
    with tempfile.TemporaryDirectory() as folder:
        served = Served(environment, folder)
        browser = start_browser()
        try:
            browser.get(served.address)
            browser.set_script_timeout(60)
            browser.execute_async_script(
                "const [done] = arguments; const look = () => "
                "window.Bokeh?.is_spared ? setTimeout(done, 500) : setTimeout(look, 50); look()")
            browser.execute_async_script(WATCH)
            for slider, begin, step in SLIDERS:
                rows = measure(browser, slider, begin, step, options.moves)
                columns = list(zip(*rows, strict=True))
                print(f"{slider:8} arrived, drawn, painted: "
                      + ", ".join(f"{statistics.median(c):.1f} ({p95(c):.1f})"
                                  for c in columns[:3])
                      + f" ms; {statistics.median(columns[3]):.0f} drawings,"
                        f" {statistics.median(columns[4]):.1f} ms", flush=True)
                table.append([slider, len(rows), *(f"{one:.4g}" for c in columns[:3]
                                                   for one in (statistics.median(c), p95(c)))])
        finally:
            browser.quit()
            served.end()
    with open(options.output, "w", encoding="utf-8", newline="") as file:
        file.write("".join(f"# {line}\n" for line in stamps(options.prefix)))
        file.write("# ms from the slider's event, by tools/measure/bench_page.py; drawn by the"
                   " processor\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["slider", "moves", *(f"{name}_ms_{word}" for name in COLUMNS
                                              for word in ("median", "p95"))])
        writer.writerows(table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
