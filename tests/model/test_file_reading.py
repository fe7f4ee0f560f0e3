import os
from pathlib import Path

import pytest

from sandbox.model.file_reading import read_ordinary


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_only_an_ordinary_file_of_some_size_is_read(tmp_path: Path) -> None:
    (tmp_path / "real").write_bytes(b"x" * 10)
    (tmp_path / "link").symlink_to(tmp_path / "real")
    os.mkfifo(tmp_path / "pipe")

    assert read_ordinary(tmp_path / "real", 10) == b"x" * 10
    assert read_ordinary(tmp_path / "real", 9) is None
    assert read_ordinary(tmp_path / "link", 10) is None
    assert read_ordinary(tmp_path / "pipe", 10) is None
