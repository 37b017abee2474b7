"""The platforms that kernels are compiled for."""

from typing import NamedTuple


class Target(NamedTuple):
    """A platform.

    Parameters
    ----------
    triple : str
        LLVM's name of it.
    zig : str
        Zig's name of it, for the linker.
    file : str
        The name of the library.
    levels : dict of str to str
        The processor that each level of the library is for; one without a name where one is enough.
    features : str
        The processor's features, in LLVM's notation.
    wheel : str
        The platform tag of a wheel that holds the library.
    """

    triple: str
    zig: str
    file: str
    levels: dict[str, str]
    features: str = ""
    wheel: str = ""


_X86 = {"v2": "x86-64-v2", "v3": "x86-64-v3", "v4": "x86-64-v4"}
WASM = "wasm32"
TARGETS = {
    "linux-x86_64": Target(
        "x86_64-unknown-linux-gnu",
        "x86_64-linux-musl",
        "linux-x86_64.so",
        _X86,
        features="-prefer-256-bit",
        wheel="manylinux_2_17_x86_64.manylinux2014_x86_64.musllinux_1_1_x86_64",
    ),
    "linux-aarch64": Target(
        "aarch64-unknown-linux-gnu",
        "aarch64-linux-musl",
        "linux-aarch64.so",
        {"": "generic"},
        wheel="manylinux_2_17_aarch64.manylinux2014_aarch64.musllinux_1_1_aarch64",
    ),
    "macos-x86_64": Target(
        "x86_64-apple-macosx11.0.0",
        "x86_64-macos.11.0",
        "macos-x86_64.dylib",
        _X86,
        wheel="macosx_11_0_x86_64",
    ),
    "macos-aarch64": Target(
        "arm64-apple-macosx11.0.0",
        "aarch64-macos.11.0",
        "macos-aarch64.dylib",
        {"": "apple-m1"},
        wheel="macosx_11_0_arm64",
    ),
    "windows-x86_64": Target(
        "x86_64-pc-windows-gnu",
        "x86_64-windows-gnu",
        "windows-x86_64.dll",
        _X86,
        wheel="win_amd64",
    ),
    WASM: Target(
        "wasm32-unknown-unknown",
        "wasm32-freestanding",
        "engine.wasm",
        {"": "generic"},
        features="+simd128,+bulk-memory,+sign-ext,+nontrapping-fptoint",
    ),
}
