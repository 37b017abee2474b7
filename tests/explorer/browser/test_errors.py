"""Errors of the drop's numbers: typed into fields, shown as errors and bands."""

import numpy as np
import pytest

import stackbounce as sb

pytestmark = pytest.mark.slow
FORMS = ("served",)  # the one file carries no errors forward


def carried(visit):
    """Wait until the page has carried the errors forward."""
    visit.page.wait_for_function("() => state.prediction")
    return visit.state("prediction")


def test_errors_are_carried_forward_and_kept_in_the_link(visits):
    visit = visits()
    page = visit.open()
    page.get_by_label("Height", exact=True).check()
    visit.ready()
    field = visit.type("height", "63 ± 1 cm")
    visit.type("balls.1.mass", "57 ± 0.5 g")
    visit.ready()
    page.wait_for_function("() => Object.keys(state.prediction?.numbers ?? {}).length == 2")
    assert field.input_value() == "0.63 ± 0.01"
    assert visit.state("errors") == {"height": 0.01, "balls.1.mass": pytest.approx(5e-4)}
    drop = visit.drop()
    assert (drop.height, drop.balls[1].mass) == (0.63, 0.057)
    exact = sb.predict(drop, {"height": (0.63, 0.01), "balls.1.mass": (0.057, 5e-4)})
    speed = exact["rebound_speeds.1"]
    numbers = page.locator("#numbers").inner_text()
    assert f"{speed.nominal_value:.2f} ± {speed.std_dev:.2f}" in numbers
    assert "Errors by derivatives" in numbers
    assert "easure height better" in numbers
    assert field.evaluate("(input) => input.scrollWidth <= input.clientWidth")
    page.wait_for_function("() => location.hash.includes('error.height=0.01')")
    again = visits()
    again.open(f"#{page.url.partition('#')[2]}")
    error = carried(again)["values"]["rebound_speeds.1"]["error"]
    assert error == pytest.approx(speed.std_dev, rel=1e-3)
    visit.type("height", "63 cm")
    page.wait_for_function("() => !('height' in state.errors)")


def test_bands_are_drawn_around_the_curves(visit):
    page = visit.open(
        "#height=0.5&balls.0.mass=0.15&balls.0.name=basketball&balls.1.mass=0.057"
        "&contacts.0.law=Spring&contacts.0.stiffness=2500&contacts.1.law=Spring"
        "&contacts.1.stiffness=1000&error.height=0.1&error.contacts.1.stiffness=200"
    )
    band = carried(visit)["band"]
    low, high = np.array(band["position"])
    frames = visit.state("result.frames")
    middle = [np.interp(band["time"], frames["time"], path) for path in frames["position"]]
    assert (low - 1e-5 <= middle).all()
    assert (middle <= high + 1e-5).all()
    assert (high - low).max() > 5e-3
    page.evaluate("() => { clock.pause(); clock.seek(0.02); }")
    painted = page.evaluate(
        """() => { const canvas = document.querySelector('.plot-canvas canvas');
             const { width, height } = canvas;
             const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
             let count = 0;
             for (let k = 3; k < data.length; k += 4) count += data[k] === 0x44;
             return count; }"""
    )
    assert painted > 500


def test_errors_go_with_the_ball_that_had_them(visit, page):
    visit.type("balls.1.mass", "57 ± 1 g")
    assert carried(visit)["method"] == "derivatives"
    visit.ready()
    page.get_by_label("Remove tennis").click()
    page.locator("[data-path='balls.1.mass']").wait_for(state="detached")
    visit.ready()
    assert visit.state("errors") == {}
    assert visit.state("prediction") is None


def test_an_error_that_is_none_is_told(visit, page):
    visit.type("balls.1.mass", "57 g ± 1 cm")
    page.get_by_text("“57 g ± 1 cm” cannot be used, the number before stays").wait_for()
    assert visit.state("errors") == {}
