"""The page's words: each sentence has its translation, and numbers are as people write them."""

import json
import math
import re
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path

import pytest
from page_build.data import model_json, options_json

from explorer.page.asking import run_node
from refusals import refusal
from stackbounce import StackbounceError, measure
from stackbounce.errors import between, finite, non_negative, positive

STATIC = files("stackbounce.explorer") / "static"
CODES = tuple(sorted(path.stem for path in Path(str(STATIC)).glob("js/languages/*.json")))
LITERAL = r'"(?:[^"\\]|\\.)*"'
CALL = re.compile(rf"(?<![\w.])t\(\s*({LITERAL})?")
PLACE = re.compile(r"\{\w+\}")
NAMED_BALLS = ("tennis", "table tennis", "golf")  # of which "ball" is said, as in sentence.js
NUMBERS = ("mass", "velocity", "impact speed", "height", "gravity", "stiffness")  # of labels
UNITS = ("kilograms", "metres", "pascals")  # that checks name in words
UNMARKED = {
    "stackbounce",
    "The explorer needs JavaScript. The command line does without: stackbounce --help.",
}


def scripts():
    paths = sorted(Path(str(STATIC)).glob("js/**/*.js"))
    return {path: path.read_text("utf-8") for path in paths if path.name != "language.js"}


class Html(HTMLParser):
    """The texts of the page's HTML: those marked to be translated, and the others."""

    def __init__(self):
        super().__init__()
        self.marked, self.others, self._open = [], [], []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if "aria-label" in given:
            (self.marked if "data-t-label" in given else self.others).append(given["aria-label"])
        if tag not in ("meta", "link"):
            self._open.append(["data-t" in given or tag == "title", ""])

    def handle_data(self, text):
        if self._open:
            self._open[-1][1] += text

    def handle_endtag(self, _tag):
        marked, text = self._open.pop()
        if text.strip():
            (self.marked if marked else self.others).append(" ".join(text.split()))


@pytest.fixture(scope="module")
def html():
    reader = Html()
    reader.feed((STATIC / "index.html").read_text("utf-8"))
    return reader


def patterns():
    text = (STATIC / "js/languages/patterns.js").read_text("utf-8")
    lists = "".join(re.findall(r"\[(.*?)\];", text, re.DOTALL))
    return [one or other for one, other in re.findall(r"""'([^']*)'|"([^"]*)\"""", lists)]


def served():
    """Return the English words and sentences that the package gives the page to show."""
    model = json.loads(model_json())
    options = json.loads(options_json())["options"]
    laws = [law["law"] for law in model["laws"]]
    names = [ball["name"] for ball in model["balls"]]
    said = [
        f"the {name} ball" if name in NAMED_BALLS else f"the {name}"
        for name in names
        if name[0].islower()
    ]
    words = [*names, *said, *(re.sub("([a-z])([A-Z])", r"\1 \2", law) for law in laws)]
    for law in model["laws"]:
        words += [law["says"]]
        words += [field[key] for field in law["fields"] for key in ("says", "words", "explains")]
    words += [one[key] for one in model["presets"] for key in ("group", "title", "says")]
    words += [one[key] for one in model["lines"] for key in ("title", "says")]
    words += [model["energy"][0]]
    words += [outcome[0] for outcome in model["outcomes"].values()]
    words += [ratio["label"] for ratio in model["ratios"].values()]
    for option in options:
        chosen = [option["example"], *option["choices"]] if option["choices"] else []
        words += [option["label"], option["says"]]
        words += [word for word in chosen if word not in laws and word not in (".", ",")]
    return [*filter(None, words), *NUMBERS, *UNITS]


def keys(html):
    """Return all sentences of the page in English."""
    calls = [json.loads(text) for one in scripts().values() for text in CALL.findall(one) if text]
    return {*html.marked, *calls, *patterns(), *served()}


def table(code):
    text = (STATIC / f"js/languages/{code}.json").read_text("utf-8")
    entries = json.loads(text, object_pairs_hook=list)
    assert len(entries) == len(dict(entries))  # none is there twice
    return dict(entries)


def test_every_call_has_its_sentence_in_it():
    """Otherwise nobody could list the sentences that need a translation."""
    for name, script in scripts().items():
        empty = [match[0] for match in CALL.finditer(script) if match[1] is None]
        assert not empty, name


def test_every_text_of_the_html_is_marked(html):
    assert set(html.others) == UNMARKED


@pytest.mark.parametrize("code", CODES)
def test_a_language_is_complete(code, html):
    """Otherwise a view has two languages in it."""
    assert keys(html) - set(table(code)) == set()


def test_german_buttons_say_what_they_do():
    words = [table("de")[word] for word in ("Undo", "Redo", "Reset")]
    assert words == ["Rückgängig", "Wiederholen", "Zurücksetzen"]


@pytest.mark.parametrize("code", CODES)
def test_a_table_has_used_sentences_with_their_places_in_one_order(code, html):
    own = table(code)
    assert set(own) - keys(html) == set()
    for english, said in own.items():
        assert said.strip(), english
        assert set(PLACE.findall(said)) == set(PLACE.findall(english)), english
    order = list(table("de"))
    assert list(own) == [key for key in order if key in own]


@pytest.fixture
def asked(page, tmp_path):
    return lambda code, *questions: run_node("ask_language", page, questions, tmp_path, code)


METRES = {"unit": "m", "size": 1}
READ = ("3,5", "3.5", "1,500", "1.500", "0,057 km", "12,5 mm", "−2,5 cm", ",5", "1,2 ft")


@pytest.mark.parametrize("code", CODES)
def test_a_comma_is_decimal_where_it_is_so(asked, code):
    read = asked(code, *(["words/words", "read", text, "m", METRES] for text in READ))
    assert read == [3.5, 3.5, 1.5, 1.5, None, 0.0125, -0.025, 0.5, 0.36576]
    written = asked(
        code,
        ["words/words", "format", 1234.5, 5],
        ["words/words", "format", 1.25e-7, 3],
        ["words/words", "fixed", -0.5, 2],
        ["words/words", "formatMeasured", 0.03, 0.00006, "s"],
        ["words/words", "splitError", "63,5 ± 0,5 cm"],
        ["words/words", "splitError", "(63,5 ± 0,5) cm"],
        ["words/words", "splitError", "63,5 ± 0,5) cm"],
    )
    split = {"value": "63,5 cm", "error": "0,5 cm"}
    assert written[:-1] == ["1234,5", "1,25e−7", "−0,50", "30,00 ± 0,06 ms", split, split]
    assert written[-1]["error"] == "0,5) cm"  # which is refused


def test_in_english_a_comma_may_part_thousands(asked):
    read = asked("en", *(["words/words", "read", text, "m", METRES] for text in READ))
    assert read == [3.5, 3.5, None, 1.5, None, 0.0125, -0.025, 0.5, 0.36576]
    assert asked("en", ["words/words", "format", 1234.5, 5]) == ["1234.5"]


MESSAGES = {
    refusal(StackbounceError, check, "n", *given).removeprefix("n "): f"Nötig ist {told} {given[0]}"
    for check, given, told in (
        (positive, (-1.0, "kilograms"), "eine positive Zahl in Kilogramm, angegeben ist"),
        (finite, (math.inf, "m/s"), "eine endliche Zahl in m/s, angegeben ist"),
        (non_negative, (-1.0, "metres"), "eine Zahl in Meter, 0 oder größer, angegeben ist"),
        (between, (4.0, 1.0, 3.0), "eine Zahl von 1 bis 3, angegeben ist"),
    )
}


def test_what_is_composed_in_english_is_translated_and_other_english_stays(asked):
    composed = {
        **MESSAGES,
        "stiffness of floor and basketball": "Steifigkeit: Boden und Basketball",
        "gap above ball 2": "Abstand über: Ball 2",
        "rebound speed of tennis over v₀": "Rückprallgeschwindigkeit durch v₀: Tennisball",
        "collisions of basketball and tennis": "Stöße: Basketball und Tennisball",
        "golf ball and marble in series": "Golfball und Murmel in Reihe",
        "tennis: impact speed of bounce 1": "Tennisball: Aufprallgeschwindigkeit: Aufprall 1",
        "from contact time": "aus: Kontaktzeit",
    }
    others = ("a loss of contact and of energy", "Cross 2007, Table I", "my own ball", "")
    composed |= {text: text for text in others}
    said = asked("de", *(["words/language", "translated", text] for text in composed))
    assert said == list(composed.values())


@pytest.mark.parametrize("code", CODES)
def test_what_measurements_find_has_its_name_in_each_language(code):
    sources = [STATIC / "js/languages/patterns.js", *Path(measure.__path__[0]).rglob("*.py")]
    text = "".join(path.read_text("utf-8") for path in sources)
    named = re.findall(r'"(.*?)"', text.partition("FOUND = ")[2].partition("];")[0])
    assert {*named, *re.findall(r'(?:Listed|Row)\("(.+?)"', text)} <= set(table(code))


def test_the_address_goes_before_the_browser(asked):
    cases = [
        ("", ["en-US", "de"], "en"),
        ("", ["de-AT", "en"], "de"),
        ("", ["pt-BR", "fr-CA", "en"], "fr"),
        ("", ["pt-BR"], "en"),
        ("#view=play&lang=es", ["de"], "es"),
        ("#lang=xx", ["de"], "de"),
    ]
    questions = [["words/language_choice", "chosen", *given] for *given, _ in cases]
    assert asked("en", *questions) == [code for *_, code in cases]
