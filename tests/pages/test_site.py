"""`make site` finds what is wrong with a site."""

import shutil

import pytest
import site_check

pytestmark = pytest.mark.slow
PAGE = '<a href="gone.html">1</a><a href="#gone">2</a><img src="http://127.0.0.1:9/x.png">'


def test_what_is_wrong_is_found(tmp_path, monkeypatch, capsys):
    if not any(map(shutil.which, site_check.BROWSERS)):
        pytest.skip("there is no Chromium on this machine")
    for name in ("index.html", "search.html"):
        (tmp_path / name).write_text(PAGE)
    monkeypatch.setattr(site_check, "SEARCHED", 100)
    assert site_check.main(tmp_path) == 1
    found = capsys.readouterr().out
    said = ("leads to gone.html", "such place", "asks for", "image-alt", "finds nothing")
    assert not [words for words in said if words not in found]
