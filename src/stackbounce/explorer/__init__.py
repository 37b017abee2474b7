"""The explorer: a page in the browser, and the server on this machine that computes for it.

=========== ================================================================
serve       finds a port, runs the server, opens the browser
addresses   the addresses that others can type, with their QR codes
app         the server's addresses: request, answer function, schema
guard       admission of requests, and the headers of every answer
framing     which sites may show the page in a frame
limits      limits of a request, of a client, and of all together
notebook    the page in a cell of a notebook, without a server
workers     worker processes, with limits of time and memory for each job
schema      the schema of requests, in pydantic
paper_pages the paper's pages, computed at the first request
answers/    the functions that compute answers in the worker processes
static/     the sources of the page: HTML, CSS, plain ES modules, and uPlot
made        the page itself: the files that were made of it when the package was built
=========== ================================================================
"""

from stackbounce.explorer.limits import LIMITS, Limits

__all__ = ["LIMITS", "Limits"]
