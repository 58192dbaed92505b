"""Compiled kernels never outlive the sources that they were made from."""

import os
import subprocess
import sys

from floorplan_core import kernel_cache


def _folder_used(environment: dict[str, str]) -> str:
    code = "import floorplan_core.geometry, os; print(os.environ.get('NUMBA_CACHE_DIR', ''))"
    run = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | environment, capture_output=True, text=True, check=True
    )
    return run.stdout.strip()


def test_the_folder_is_named_by_the_sources(tmp_path, monkeypatch):
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    folder = _folder_used({"XDG_CACHE_HOME": str(tmp_path), "HOME": str(tmp_path)})
    assert folder.endswith(kernel_cache.source_digest())
    assert os.path.isdir(folder)


def test_the_users_choice_wins(tmp_path):
    assert _folder_used({"NUMBA_CACHE_DIR": str(tmp_path)}) == str(tmp_path)


def test_the_digest_follows_every_source_with_kernels(tmp_path, monkeypatch):
    (tmp_path / "geometry").mkdir()
    kernel, other = tmp_path / "geometry" / "kernel.py", tmp_path / "geometry" / "other.py"
    kernel.write_text("from numba import njit\n")
    other.write_text("plain = 1\n")
    monkeypatch.setattr(kernel_cache, "__file__", str(tmp_path / "kernel_cache.py"))
    before = kernel_cache.source_digest()
    other.write_text("plain = 2\n")
    assert kernel_cache.source_digest() == before
    kernel.write_text("from numba import njit  # changed\n")
    assert kernel_cache.source_digest() != before


def test_only_the_newest_folders_stay(tmp_path):
    folders = [tmp_path / f"state{k}" for k in range(6)]
    for age, folder in enumerate(folders):
        folder.mkdir()
        os.utime(folder, (1000 + age, 1000 + age))
    kernel_cache._forget_old(folders[-1])
    assert sorted(p.name for p in tmp_path.iterdir()) == ["state2", "state3", "state4", "state5"]
