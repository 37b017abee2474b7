"""The figure of all plots, which a notebook shows as the last line of a cell."""

import io

from matplotlib import figure

_SHARP = 2.0  # pixels per pixel of the page


class Figure(figure.Figure):
    """A figure of matplotlib that pyplot does not know, and that has a picture of itself.

    Once ``%matplotlib inline`` is on, IPython draws all figures of matplotlib, this one, too, and
    does not ask for its picture.

    Examples
    --------
    >>> png, size = Figure(figsize=(4.0, 3.0))._repr_png_()
    >>> png[1:4], size
    (b'PNG', {'width': 400.0, 'height': 300.0})
    """

    def _repr_png_(self) -> tuple[bytes, dict[str, float]]:
        """Return the picture as a PNG file, and its size in pixels of the page."""
        stream = io.BytesIO()
        self.savefig(stream, format="png", dpi=_SHARP * self.dpi)
        width, height = self.get_size_inches() * self.dpi
        return stream.getvalue(), {"width": float(width), "height": float(height)}
