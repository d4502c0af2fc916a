"""Rollouts of a policy in files with the layout of Minari, for offline learning."""
from __future__ import annotations

import json
import os
import pathlib
import tempfile
import typing

import numpy

from ._errors import InputError

_VERSION = "0.5.3"  # of Minari, whose layout this is


def _serialized(space: typing.Any) -> str:
    """A space in the form of Minari's metadata."""
    out: dict[str, typing.Any] = {"type": type(space).__name__, "dtype": str(space.dtype)}
    if hasattr(space, "low"):
        out.update(shape=list(space.shape), low=space.low.tolist(), high=space.high.tolist())
    elif hasattr(space, "n"):
        out.update(start=int(getattr(space, "start", 0)), n=int(space.n))
    else:
        out.update(nvec=numpy.asarray(space.nvec).tolist())
    return json.dumps(out)


def _episode(env: typing.Any, policy: typing.Callable[[typing.Any], typing.Any], seed: int | None) -> dict[str, typing.Any]:
    observation, _ = env.reset(seed=seed)
    observations = [observation]
    steps: list[tuple[typing.Any, ...]] = []
    while not steps or not (steps[-1][2] or steps[-1][3]):
        action = policy(observation)
        observation, reward, terminated, truncated, _ = env.step(action)
        observations.append(observation)
        steps.append((action, reward, terminated, truncated))
    columns = [numpy.array(column) for column in zip(*steps)]
    return {"observations": numpy.array(observations), **dict(zip(("actions", "rewards", "terminations", "truncations"), columns))}


def save_rollouts(
    folder: str | os.PathLike[str], env: typing.Any, policy: typing.Callable[[typing.Any], typing.Any], *, episodes: int, seed: int = 1
) -> pathlib.Path:
    """Runs a policy in an environment, and saves what it saw, did and got as a dataset for offline learning. Returns the file of the numbers.

    folder: the dataset's folder, whose last part is its name, such as "light-v0". It must not exist. Minari finds it below MINARI_DATASETS_PATH.
    env: a BugEnv, or another environment of Gymnasium whose spaces are Box, Discrete or MultiDiscrete. The first episode is reset with the seed.
    policy: a function from an observation to an action.

    The file data/main_data.hdf5 has a group episode_N for each episode, with observations (one more than steps), actions, rewards, terminations and
    truncations; data/metadata.json has the spaces and the counts. Raises InputError. Needs h5py.
    """
    import h5py

    target = pathlib.Path(folder).absolute()
    if episodes < 1:
        raise InputError(f"save_rollouts(): there must be at least one episode, not {episodes}")
    if target.exists():
        raise InputError(f"save_rollouts(): '{target}' exists: remove it, or give the dataset another name")
    rollouts = [_episode(env, policy, None if i else seed) for i in range(episodes)]
    metadata = {
        "total_episodes": episodes,
        "total_steps": sum(len(rollout["rewards"]) for rollout in rollouts),
        "data_format": "hdf5",
        "observation_space": _serialized(env.observation_space),
        "action_space": _serialized(env.action_space),
        "dataset_id": target.name,
        "minari_version": _VERSION,
    }
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent) as place:  # so that there is a whole dataset, or none
        data = pathlib.Path(place, target.name, "data")
        data.mkdir(parents=True)
        with h5py.File(data / "main_data.hdf5", "w", track_order=True) as file:
            for i, rollout in enumerate(rollouts):
                group = file.create_group(f"episode_{i}")
                group.attrs.update(id=i, total_steps=len(rollout["rewards"]), **({} if i else {"seed": seed}))
                for name, values in rollout.items():
                    group.create_dataset(name, data=values)
        (data / "metadata.json").write_text(json.dumps(metadata))
        data.parent.rename(target)
    return target / "data/main_data.hdf5"
