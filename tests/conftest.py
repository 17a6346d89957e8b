"""Options of the tests."""


def pytest_addoption(parser):
    parser.addoption(
        "--compiled", action="store_true", help="load the compiled kernel first: all solves use it"
    )


def pytest_configure(config):
    if config.getoption("--compiled"):
        from antinode.kernel import kernel

        kernel()
