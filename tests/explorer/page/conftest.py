"""The page's own code, laid out for node."""

import shutil

import pytest

from explorer.page.asking import ask, lay_out


@pytest.fixture(scope="session")
def page(tmp_path_factory):
    if not shutil.which("node"):
        pytest.skip("node is not installed")
    return lay_out(tmp_path_factory.mktemp("page"))


@pytest.fixture
def asked(page, tmp_path):
    return lambda questions, **options: ask(page, questions, tmp_path, **options)
