"""The explorer: a page in the browser, and the server on this machine that computes for it.

========= ====================================================================
serve     finds a port, runs the server, opens the browser
app       the server's addresses: what is asked there, and who answers
guard     which requests are let in at all, and the headers of every answer
patience  how long a connection may be silent
limits    how much one request may ask for
work      processes that compute, each job with a time limit
schema    what requests and answers look like: pydantic over the model
papers    the paper's pages, computed when they are first asked for
answers/  what is computed for each address, run in the worker processes
static/   the page: HTML, CSS, plain ES modules, and uPlot
========= ====================================================================
"""

from stackbounce.extras import need
from stackbounce.web.limits import LIMITS, Limits

__all__ = ["LIMITS", "Limits"]

need("web", "stackbounce app")
