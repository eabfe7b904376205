"""Reports of the package are those of the command."""

import pytest

import topple

MAP = ["--object", 1, "--t-h", 1.75, "--t-v", 0.75, "--omega", "2:12:6", "--a-h", "1:12:6", "--backend", "cpu", "--verify", "none"]


@pytest.mark.parametrize("ending", ["html", "pdf"])
def test_a_report_is_that_of_the_command(command, tmp_path, monkeypatch, ending):
    monkeypatch.chdir(tmp_path)
    command("pulse", *MAP, "--out", "map")
    command("report", "map", "--title", "Statue & base", "--out", f"command.{ending}")
    topple.report("map", f"package.{ending}", title="Statue & base")
    own, other = ((tmp_path / f"{name}.{ending}").read_bytes() for name in ("package", "command"))
    assert own == other and len(own) > 10_000
    topple.report(["map", "map"], tmp_path / f"package.{ending}")
    assert (tmp_path / f"package.{ending}").read_bytes() != own


def test_what_is_no_run_and_no_name_is_refused(command, tmp_path):
    with pytest.raises(ValueError, match="^runs: .*no results of topple"):
        topple.report(tmp_path, tmp_path / "report.html")
    with pytest.raises(ValueError, match="^runs: give the directory of a run"):
        topple.report([], tmp_path / "report.html")
    command("pulse", *MAP, "--out", tmp_path / "map")
    for name, problem in (("report.txt", "^out: .*html or .pdf"), ("mine.html", "^out: .*no report of topple")):
        (tmp_path / "mine.html").write_text("mine")
        with pytest.raises(ValueError, match=problem):
            topple.report(tmp_path / "map", tmp_path / name)
    with pytest.raises(ValueError, match="^title: must be one line"):
        topple.report(tmp_path / "map", tmp_path / "report.html", title="two\nlines")
    assert not (tmp_path / "report.html").exists()
