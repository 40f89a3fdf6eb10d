import os
import shutil
import subprocess

import pytest


@pytest.fixture(scope="session")
def program():
    """Runs the program: HAIRLINE, or the wheel's own."""
    path = os.environ.get("HAIRLINE") or shutil.which("hairline")
    def run(*words, code=0):
        done = subprocess.run([path, *words], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return done.stdout
    return run
