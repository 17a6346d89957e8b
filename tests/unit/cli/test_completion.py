"""Completion of commands and options in the shell."""

import shutil
import subprocess

import pytest

from cli_run import refused, run


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME", "ZSH_CUSTOM"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_bash_completes_commands_and_options(home):
    assert run("--install-completion", "bash").code == 0
    script = home / ".local" / "share" / "bash-completion" / "completions" / "antinode"
    assert str(script) in (home / ".bashrc").read_text()

    def offered(*words):
        typed = " ".join(words)
        ask = (
            f"source {script}; COMP_WORDS=({typed}); COMP_CWORD={len(words) - 1}; "
            f"COMP_LINE='{typed}'; COMP_POINT=${{#COMP_LINE}}; _antinode; echo ${{COMPREPLY[@]}}"
        )
        done = subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=True)
        return done.stdout.split()

    assert offered("antinode", "stab") == ["stability"]
    assert "--buckling" in offered("antinode", "beam", "--buck")


@pytest.mark.parametrize("shell", ["zsh", "fish", "powershell"])
def test_other_shells_are_written_into_a_file(home, shell):
    target = home / "completions"
    assert run("--install-completion", shell, "--output", target).code == 0
    text = target.read_text()
    assert "stability" in text
    assert "buckling" in text
    assert sorted(path.name for path in home.iterdir()) == ["completions"]


def test_a_shell_that_is_not_known(home):
    refused(run("--install-completion", "tcsh"), "tcsh", "bash")
