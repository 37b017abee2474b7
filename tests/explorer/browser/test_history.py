"""Undo, redo, reset, and the browser's Back."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)  # the other forms have the same modules

FIRST_MASS = 0.057


def mass(visit):
    return visit.state("drop.balls[1].mass")


def drag(page, slider, share):
    """Drag a slider to a share of its width, in many small movements."""
    box = page.locator(slider).bounding_box()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 2, y)
    page.mouse.down()
    page.mouse.move(box["x"] + share * box["width"], y, steps=8)
    page.mouse.up()


def test_one_movement_of_a_slider_is_one_step(visit, page):
    undo, redo = (page.get_by_role("button", name=name, exact=True) for name in ("Undo", "Redo"))
    assert undo.is_disabled()
    assert redo.is_disabled()
    drag(page, "[data-slider='balls.1.mass']", 0.8)
    first = mass(visit)
    assert first != FIRST_MASS
    drag(page, "[data-slider='balls.1.mass']", 0.2)
    second = mass(visit)
    assert second != first
    undo.click()
    assert mass(visit) == first
    undo.click()
    assert mass(visit) == FIRST_MASS
    assert page.locator("[data-path='balls.1.mass']").input_value() == "57"
    assert undo.is_disabled()
    redo.click()
    redo.click()
    assert mass(visit) == second
    assert redo.is_disabled()
    page.get_by_label("Remove tennis").click()
    visit.ready()
    page.keyboard.press("Control+z")
    assert mass(visit) == second
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+y")
    page.keyboard.press("Control+Shift+Z")
    assert len(visit.state("drop.balls")) == 1


def test_keys_in_a_field_are_the_fields_own(visit):
    visit.open()
    field = visit.type("balls.1.mass", "60 g")
    assert mass(visit) == 0.06
    field.press("Control+z")
    assert mass(visit) == 0.06


def test_a_reset_can_be_undone(visit, page):
    page.get_by_label("Remove tennis").click()
    page.wait_for_function("() => state.drop.balls.length === 1")
    page.get_by_role("button", name="Reset").click()
    assert len(visit.state("drop.balls")) == 2
    page.get_by_role("button", name="Undo", exact=True).click()
    assert len(visit.state("drop.balls")) == 1


def test_back_undoes_views_and_examples_and_keeps_the_drop(visit, page):
    page.get_by_role("tab", name="Map").click()
    visit.type("balls.1.mass", "70 g")
    page.go_back()
    page.wait_for_function("() => state.view === 'play'")
    assert mass(visit) == 0.07  # changed after the view that Back undid
    page.get_by_label("Example").select_option("figure-5")
    assert visit.state("drop.balls.length") == 2
    assert mass(visit) != 0.07
    page.get_by_role("tab", name="Line").click()
    page.go_back()
    page.wait_for_function("() => state.view === 'play'")
    assert mass(visit) != 0.07
    page.go_back()
    page.wait_for_function("() => state.drop.balls[1].mass === 0.07")
    page.go_forward()
    page.wait_for_function("() => state.drop.balls[1].mass !== 0.07")
    page.keyboard.press("Control+z")
    assert mass(visit) == 0.07


def choose(visit, contact, law):
    visit.page.locator(f"[data-key=law-{contact}]").select_option(law)
    visit.page.wait_for_function(f"() => state.drop.contacts[{contact}].law === '{law}'")


def test_one_rigid_law_can_be_chosen_for_one_contact(visit):
    visit.open()
    laws = "contacts.map((one) => one.law)"
    choose(visit, 0, "Rigid")
    choose(visit, 1, "RigidLossBySpeed")
    assert visit.state(f"drop.{laws}") == ["Rigid", "RigidLossBySpeed"]
    choose(visit, 0, "Spring")
    assert visit.state(f"drop.{laws}") == ["Spring", "Spring"]
