"""Long calls that a signal, such as Ctrl-C, can end.

Python looks at signals in its main thread between two of its own instructions, so not during a
call of the library. A long one is therefore made in a thread of its own, for which the main thread
waits in a way that signals end; the call itself goes on to its end and what it works on has to stay
until then. In other threads there is nothing to wait for.
"""

from __future__ import annotations

import _thread
import threading
from typing import Any, Callable, List


def interruptible(call: Callable[[], Any], abandon: Callable[[], Any] = lambda: None) -> Any:
    """What a call gives; `call` keeps alive what it needs and raises nothing.

    `abandon` is called when a signal's exception, which goes on, leaves the call running.
    """
    if _thread.get_ident() != threading.main_thread().ident:
        return call()
    done = _thread.allocate_lock()
    done.acquire()
    answer: List[Any] = []

    def work() -> None:
        try:
            answer.append(call())
        finally:
            done.release()

    try:
        _thread.start_new_thread(work, ())
        done.acquire()
    except RuntimeError:  # no more threads, or Python is ending
        return call()
    except BaseException:
        if not answer:
            abandon()
        raise
    return answer[0]
