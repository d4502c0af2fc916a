"""What a probe has recorded, and its way to other packages, which are imported when they are needed."""
from __future__ import annotations

import math

TYPE_CHECKING = False  # that of `typing`, whose import takes time
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    import numpy
    from numpy.typing import DTypeLike, NDArray


class Recording:
    """Rows of numbers, one per recorded cycle, with what they are.

    NumPy takes it as the array `data`.
    """

    def __init__(
        self,
        source: str,
        label: str,
        cycles: NDArray[numpy.uint64],
        data: NDArray[numpy.float64],
        columns: Sequence[str],
        first: tuple[int, int],
        every: int,
        seconds_per_cycle: float,
    ) -> None:
        self.source = source
        """What was recorded, such as "Bug/Light:act"."""
        self.label = label
        """The state's name for people, such as "Activity"; may be empty."""
        self.cycles = cycles
        """The numbers of the recorded cycles: an array of shape (rows,)."""
        self.data = data
        """The numbers: (rows, rows of cells, columns of cells), (rows, cells) of a sparse group, (rows,) of a mean."""
        self.every = every
        """The number of cycles from one row to the next."""
        self.seconds_per_cycle = seconds_per_cycle
        self._columns = columns
        self._first = first

    @property
    def seconds(self) -> NDArray[numpy.float64]:
        """The time of each row, in seconds of the world since the start: an array of shape (rows,)."""
        import numpy

        return self.cycles.astype(numpy.float64) * self.seconds_per_cycle

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of `data`."""
        return self.data.shape

    def __len__(self) -> int:
        return len(self.cycles)

    def __getitem__(self, index: Any) -> Any:
        return self.data[index]

    def __array__(self, dtype: DTypeLike = None, copy: bool | None = None) -> NDArray[Any]:
        data: NDArray[Any] = self.data if dtype is None else self.data.astype(dtype, copy=False)
        return data.copy() if copy else data

    def __repr__(self) -> str:
        return f"<forage.Recording of '{self.source}', {' x '.join(map(str, self.shape))}>"

    def _repr_html_(self) -> str:
        from . import _html

        return str(_html.recording(self))  # type: ignore[no-untyped-call]

    def _table(self) -> NDArray[numpy.float64]:
        return self.data.reshape(len(self.cycles), math.prod(self.shape[1:]))

    def to_pandas(self) -> Any:
        """A pandas.DataFrame: one row per cycle, one column per cell, named as in the files of `forage run --record`."""
        import pandas

        return pandas.DataFrame(self._table(), index=pandas.Index(self.cycles, name="cycle"), columns=self._columns)

    def to_xarray(self) -> Any:
        """A xarray.DataArray with the dimensions cycle, y and x, and the coordinate seconds. Cells count from 1."""
        import numpy
        import xarray

        x, y = self._first
        dims = {1: ("cycle",), 2: ("cycle", "cell"), 3: ("cycle", "y", "x")}[self.data.ndim]
        first = {"x": x, "y": y, "cell": x}
        coords: dict[str, Any] = {d: numpy.arange(n) + first[d] for d, n in zip(dims[1:], self.shape[1:])}
        coords["cycle"] = self.cycles
        coords["seconds"] = ("cycle", self.seconds, {"units": "s"})
        attributes = {"long_name": self.label, "every": self.every, "seconds_per_cycle": self.seconds_per_cycle}
        return xarray.DataArray(self.data, dims=dims, coords=coords, name=self.source, attrs=attributes)

    def to_neo(self) -> Any:
        """A neo.AnalogSignal, dimensionless, with one channel per cell."""
        import neo
        import quantities

        cycle = self.seconds_per_cycle * quantities.s
        times = {"t_start": (self.cycles[0] if len(self) else 0) * cycle, "sampling_period": self.every * cycle}
        return neo.AnalogSignal(self._table(), units="dimensionless", name=self.source, description=self.label, **times)
