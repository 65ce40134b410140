"""Many gaps over the workers of Dask: a wheel on a rail over displacements, loads and creepages.

    gaps_by_dask.py [-o OUT.csv] [--wheel NAME] [--rail NAME] [--displacements N] [--workers N]
                    [--scheduler ADDRESS]

Without --scheduler Dask's LocalCluster starts workers on this machine. On a cluster one job runs
`dask scheduler`, others `dask worker ADDRESS --nthreads 1`, and this program is given the ADDRESS:
nothing else changes. A task is a few gaps with all loads and creepages; each worker makes its gaps
itself, so that only numbers travel.
"""

from __future__ import annotations

import argparse
import contextlib
from collections.abc import Iterator
from typing import Any

import dask.distributed
import faststrip
import numpy as np
import pandas

LOADS = np.linspace(4e4, 1.2e5, 9)  # vertical, N
CREEPAGES = np.linspace(-5e-3, 5e-3, 11)  # longitudinal
GAPS_A_TASK = 8


def solve_part(wheel: str, rail: str, places: np.ndarray) -> Any:
    """Contacts of some displacements, as a table: a row for each load and creepage of each."""
    gaps = [faststrip.profile_gap(wheel, rail, shift=float(y)) for y in places]
    angle = np.array([gap.angle for gap in gaps])
    # Axes: loads, creepages, gaps; the library runs on the one thread that Dask gave the task.
    many = faststrip.solve_many(gaps, load=LOADS[:, None, None] / np.cos(angle),
                                creepage=(CREEPAGES[:, None], 0.0, -np.sin(angle) / 460.0),
                                contact_angle=angle, threads=1)
    axes = (LOADS, CREEPAGES, places)
    names = ("vertical_load", "cksi", "y")
    columns = dict(zip(names, (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))))
    found = many.to_pandas().reset_index(drop=True)
    return pandas.concat([pandas.DataFrame(columns), found], axis=1)


@contextlib.contextmanager
def client_of(scheduler: str, workers: int) -> Iterator[Any]:
    """A client of a cluster that runs, or of workers on this machine."""
    if scheduler:
        with dask.distributed.Client(scheduler) as client:
            yield client
        return
    with dask.distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1, host="127.0.0.1",
            dashboard_address=None) as cluster, dask.distributed.Client(cluster) as client:
        yield client


def main() -> None:
    """Deal the displacements, gather the tables in their order."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("-o", default="contacts.csv", metavar="OUT.csv")
    parser.add_argument("--wheel", default="s1002", help="a name")
    parser.add_argument("--rail", default="60e1", help="a name")
    parser.add_argument("--displacements", type=int, default=61, metavar="N")
    parser.add_argument("--workers", type=int, default=2, metavar="N")
    parser.add_argument("--scheduler", default="", metavar="ADDRESS")
    words = parser.parse_args()
    places = np.linspace(-6.0, 6.0, words.displacements)
    parts = [places[i:i + GAPS_A_TASK] for i in range(0, len(places), GAPS_A_TASK)]
    with client_of(words.scheduler, words.workers) as client:
        # A task whose worker is lost is done anew by another one.
        tasks = [client.submit(solve_part, words.wheel, words.rail, part) for part in parts]
        table = pandas.concat(client.gather(tasks), ignore_index=True)
    table.to_csv(words.o, index=False)
    print(f"{len(table)} contacts in {len(tasks)} tasks:", table["word"].value_counts().to_dict())


if __name__ == "__main__":
    main()
