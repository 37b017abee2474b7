"""Whatever comes in, as the description has it or not, is answered in words."""

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import content_type_conformance, status_code_conformance

pytestmark = pytest.mark.slow

CHECKS = [not_a_server_error, status_code_conformance, content_type_conformance]
OPERATIONS = [
    ("GET", "/api/places"),
    ("POST", "/api/predict"),
    ("POST", "/api/measure"),
    ("POST", "/api/fit"),
]


@pytest.fixture(scope="session")
def description(address_of_server):
    return schemathesis.openapi.from_url(f"{address_of_server}api/openapi.json")


def test_the_list_above_is_whole(description):
    described = [operation.ok() for operation in description.get_all_operations()]
    assert sorted((one.method.upper(), one.path) for one in described) == sorted(OPERATIONS)


@pytest.mark.parametrize(
    ("method", "path", "mode"),
    [
        (method, path, mode)
        for method, path in OPERATIONS
        for mode in GenerationMode
        if method == "POST" or mode is GenerationMode.POSITIVE  # nothing to be wrong in a GET
    ],
)
def test_every_request_gets_an_answer_as_described(description, method, path, mode):
    checks = list(HealthCheck)

    @settings(max_examples=15, deadline=None, suppress_health_check=checks, database=None)
    @given(case=description[path][method].as_strategy(generation_mode=mode))
    def ask(case):
        response = case.call()
        case.validate_response(response, checks=CHECKS)
        if response.status_code >= 400:
            assert "\n" not in response.json()["detail"]
            assert "Traceback" not in response.text

    ask()
