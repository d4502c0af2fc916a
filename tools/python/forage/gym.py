"""Robots for learning agents: environments with the interfaces of Gymnasium and PettingZoo.

    from forage.gym import BugEnv

    env = BugEnv("systems/worlds/basic_arena.world", sensors=["target"])
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

The environments are subclasses of gymnasium.Env, gymnasium.vector.VectorEnv and pettingzoo.ParallelEnv where these are
installed, and have the same methods elsewhere.
"""
from __future__ import annotations

import itertools
import operator
import os
import typing

import numpy
import numpy.typing

from . import _forage
from ._errors import InputError, RunError
from ._rollouts import save_rollouts

try:
    from gymnasium import Env, spaces
    from gymnasium import vector as _vector
    from gymnasium.vector import VectorEnv
    from gymnasium.vector.utils import batch_space

    _next_step = _vector.AutoresetMode.NEXT_STEP if hasattr(_vector, "AutoresetMode") else "NextStep"
except ImportError:
    from . import _spaces as spaces
    from ._spaces import Env, VectorEnv, batch_space

    _next_step = "NextStep"
try:
    from pettingzoo import ParallelEnv
except ImportError:
    from ._spaces import ParallelEnv

__all__ = ["BugEnv", "BugParallelEnv", "BugVectorEnv", "save_rollouts"]

_Path = typing.Union[str, "os.PathLike[str]"]
_Ports = typing.Any
"""Names, one name, or names with (rows, columns); of several robots, a dictionary of these."""
_render_modes = ["rgb_array", "human"]
_Observation = numpy.typing.NDArray[numpy.float32]
_Info = typing.Dict[str, typing.Any]
_Flags = numpy.typing.NDArray[numpy.bool_]
_Robots = typing.Dict[str, typing.Any]
"""By robot."""


def _ports(ports: typing.Any) -> typing.Any:
    """Sensors or motors as names with rows and columns: 0 for the usual size."""
    if isinstance(ports, str):
        ports = [ports]
    sizes = ports if isinstance(ports, dict) else dict.fromkeys(ports)
    for name, size in sizes.items():
        if size and min(size) < 1:
            raise InputError(f"'{name}' cannot have the size {size!r}: give (rows, columns), each at least 1, or None for the usual size")
    return [(name, *(size or (0, 0))) for name, size in sizes.items()]


def _agent(robot: str, system: typing.Any, sensors: typing.Any, motors: typing.Any, reward: typing.Any) -> typing.Any:
    if system is not None and (sensors is None or motors is None):
        raise InputError("with a system, name its sensor and motor groups: sensors=['Bug/Light'], motors=['Bug/Motor']")
    if not (reward is None or isinstance(reward, str) or callable(reward)):
        raise InputError(f"the reward {reward!r} is neither a source, such as 'mean(Bug/Light)', nor a function of the environment")
    expression = reward if isinstance(reward, str) else ""
    return (robot, _ports("target" if sensors is None else sensors), _ports("motor" if motors is None else motors), expression)


def _task(world: typing.Any, system: typing.Any, agents: typing.Any, options: typing.Any, every_robot: bool = False) -> dict[str, typing.Any]:
    usual: dict[str, typing.Any] = {"action": "cell", "cycles_per_step": 5, "max_steps": 1000, "end_at_target": True, "speed": (1.0, 1.5), "seed": 1}
    usual.update(settings=None, plugins=(), noise=True, real_time_factor=None, paths=False)
    unknown = set(options) - set(usual)
    if unknown:
        raise TypeError(f"unknown options: {', '.join(sorted(unknown))}; there are {', '.join(usual)}")
    for name in ("end_at_target", "noise", "paths"):
        if not isinstance(options.get(name, True), (bool, numpy.bool_)):
            raise InputError(f"{name} is True or False, not {options[name]!r}")
    return {"world": world, "system": system, "agents": agents, "every_robot": every_robot, **usual, **options}


def _observation_space(sensors: typing.Any) -> typing.Any:
    high = numpy.concatenate([numpy.full(shape, 1 if unit_range else numpy.inf, numpy.float32).ravel() for _, shape, unit_range in sensors])
    return spaces.Box(numpy.where(high == 1, numpy.float32(0), -high), high, dtype=numpy.float32)


def _action_space(motors: typing.Any, action: typing.Any) -> typing.Any:
    cells = [int(numpy.prod(shape)) for _, shape, _ in motors]
    if action == "cell":
        choices = [max(n, 2) for n in cells]
        return spaces.Discrete(choices[0]) if len(choices) == 1 else spaces.MultiDiscrete(choices)
    low = [x for n in cells for x in ([0.0] * n if action == "activity" else [-1.0] * 2 if n > 1 else [0.0])]
    return spaces.Box(numpy.array(low, numpy.float32), numpy.ones(len(low), numpy.float32), dtype=numpy.float32)


def _assignment(name: str, value: typing.Any) -> str:
    if isinstance(value, (bool, numpy.bool_)):
        value = str(bool(value)).lower()
    elif not isinstance(value, (str, int, float, numpy.number)):
        raise InputError(f"set(): {name} cannot be {value!r}: give a number, a text, True or False")
    return f"{name}={value}"


def _each(name: typing.Any, values: typing.Any) -> typing.Any:
    """The names and values of set(), which are two arguments or a dictionary."""
    if isinstance(name, dict):
        if values is not None:
            raise InputError("set(): give a dictionary, or a name and its values")
        return name.items()
    if not isinstance(name, str) or values is None:
        raise InputError("set(): give a name and its values, or a dictionary of them")
    return [(name, values)]


def _option(options: typing.Any, *known: str) -> list[typing.Any]:
    """The options of reset() with these names; None for those that are not given."""
    if not (options is None or isinstance(options, dict)):
        raise InputError(f"reset(): the options {options!r} are no dictionary, such as {{'start': (0, -1, 1.57)}}")
    unknown = set(options or {}) - set(known)
    if unknown:
        raise InputError(f"reset(): unknown options {', '.join(sorted(map(str, unknown)))}; there is {' and '.join(known)}")
    return [(options or {}).get(name) for name in known]


def _pose(start: typing.Any) -> typing.Any:
    pose = numpy.asarray(start)
    if pose.shape != (3,) or pose.dtype.kind not in "iuf":
        raise InputError(f"reset(): the start {start!r} is not a pose, such as (0, -1, 1.57): x, y and the heading, in m and rad")
    return tuple(pose.tolist())


def _starts(options: typing.Any, robots: typing.Any) -> typing.Any:
    """The start poses in the options of reset(): "start" is one of them, or a dictionary by robot."""
    (start,) = _option(options, "start")
    if start is None:
        return []
    if not isinstance(start, dict):
        return [_pose(start)]
    if set(start) != set(robots):
        raise InputError(f"reset(): start has a pose for {', '.join(map(str, start))}, and must have one for each of {', '.join(robots)}")
    return [_pose(start[r]) for r in robots]


def _seed(seed: typing.Any) -> int | None:
    """A seed of reset(): any integer that Python or NumPy has."""
    if seed is None:
        return None
    number = operator.index(seed)
    if not 0 <= number < 1 << 64:
        raise InputError(f"reset(): the seed {number} is not from 0 to 2**64 - 1")
    return number


def _arguments(names: dict[str, typing.Any]) -> dict[str, typing.Any]:
    """The arguments of __init__(), from its local names."""
    options = names.pop("options")
    return {**{n: v for n, v in names.items() if n not in ("self", "__class__")}, **options}


def _number(reward: typing.Any) -> float:
    if isinstance(reward, (str, bytes)) or numpy.ndim(reward) > 0:
        raise TypeError(f"the reward is a number, not {reward!r}")
    return float(reward)


class _Sensing:
    """What has sensors."""

    sensors: typing.Any

    def split(self, observation: typing.Any) -> dict[str, typing.Any]:
        """The sensors in an observation: a dictionary of arrays with the shapes of their groups."""
        ends = numpy.cumsum([numpy.prod(shape) for _, shape, _ in self.sensors])
        return {name: part.reshape(shape) for (name, shape, _), part in zip(self.sensors, numpy.split(observation, ends[:-1]))}


class _Kept:
    """Environments are copied and pickled by their arguments and their state. Only those whose run has no probes,
    manipulations or measures can be, and not their windows."""

    _made: dict[str, typing.Any]
    _uses = "_agents"

    def __getstate__(self) -> dict[str, typing.Any]:
        use = getattr(self, self._uses)
        left_out = ("_made", "_agents", "_pool", "_figure", "_image", "envs")
        attributes = {name: value for name, value in vars(self).items() if name not in left_out}
        return {"made": self._made, "attributes": attributes, "state": None if use is None else use.save()}

    def __setstate__(self, kept: dict[str, typing.Any]) -> None:
        self.__init__(**kept["made"])  # type: ignore[misc]
        use = getattr(self, self._uses)
        vars(self).update(kept["attributes"])
        if kept["state"] is None:
            setattr(self, self._uses, None)
        else:
            use.restore(kept["state"])


class _Rendered(_Kept):
    """What the environments of one run share: the run, its pictures, and its end."""

    _agents: _forage.AgentRun | None = None
    _figure: typing.Any = None

    def _open(self, task: dict[str, typing.Any], render_mode: str | None) -> None:
        if render_mode not in (None, *_render_modes):
            raise InputError(f"'{render_mode}' is not a way to render; there are {', '.join(_render_modes)}, and None")
        self.render_mode = render_mode
        self._agents = _forage.AgentRun(**task)

    @property
    def _use(self) -> _forage.AgentRun:
        if self._agents is None:
            raise RunError("this environment is closed")
        return self._agents

    @property
    def run(self) -> _forage.Run:
        """The forage.Run in which the agents act, to read, record and change; reset(seed=...) makes a new one, Run.restarted().

        Only what the agents sense, the reward and the modules depend on is computed in it.
        """
        return self._use.run

    def set(self, name: typing.Any, values: typing.Any = None) -> None:
        """Sets a parameter, env.set("Process/Group.threshold", 0.5), or the weights of a connection, env.set("A to B", weights).

        A dictionary sets several, one after the other. Weights are an array of shape (targets, sources), as run["A to B"].weight is. They hold until
        they are set again, also after reset(seed=...). Raises InputError, and leaves the value as it was.
        """
        for what, value in _each(name, values):
            if self._use.is_connection(what):
                self._use.set_weights(what, value)
            else:
                self._use.set_parameter(_assignment(what, value))

    def render(self) -> typing.Any:
        """The world from above, and what cameras see: an array of shape (height, width, 3) of bytes, or a window ("human").

        The window needs matplotlib.
        """
        if self.render_mode is None:
            return None
        picture = self._use.picture()
        if self.render_mode == "rgb_array":
            return picture
        self._show(picture)

    def _show(self, picture: typing.Any) -> None:
        from matplotlib import pyplot

        if self._figure is None:
            self._figure = pyplot.figure(figsize=(picture.shape[1] / 100, picture.shape[0] / 100))
            axes = self._figure.add_axes((0, 0, 1, 1))
            axes.axis("off")
            self._image = axes.imshow(picture)
            pyplot.ion()
            self._figure.show()
        self._image.set_data(picture)
        self._figure.canvas.draw_idle()
        self._figure.canvas.flush_events()

    def close(self) -> None:
        """Frees the run. Closing again does nothing; other uses then raise RunError."""
        if self._figure is not None:
            from matplotlib import pyplot

            pyplot.close(self._figure)
            self._figure = None
        self._agents = None


class BugEnv(_Sensing, _Rendered, Env):  # type: ignore[misc]
    """A robot in a world, as an environment of Gymnasium.

    An episode is a trial: the robot starts at the next start pose of the world, and the episode ends when it reaches a
    target or leaves the bounds. It is truncated after max_steps. A step is cycles_per_step cycles.

    world: a .world file.
    system: an .iqr file, the brain in the loop; without one, sensors and motors are all there is.
    sensors: without a system, names such as "target", "proximity", "image_RH", "gps", "placeCell" (`forage types
        moduleGazeboBug` lists them, with a leading '_'), or a dictionary with their (rows, columns); with a system, sources
        such as "Bug/Light". An observation is one vector of 32-bit numbers, all sensors one after the other.
    motors: without a system "motor" and "gripper", or a dictionary with (rows, columns); with a system, groups such as
        "Bug/Motor". Their activity is overwritten in every cycle.
    action: "cell": the number of the active cell of each motor group, counted row by row, 0 or 1 for a single cell. Without a
        system the usual motor group is 3 x 3: rows forward, stand, backward; columns left, straight, right. "velocity":
        forward and turn, -1 to 1, as the nearest cell. "activity": the activities of all cells.
    reward: None: 1 in the step in which the robot reaches a target. A source of one number, such as "mean(Bug/Light)", after
        the last cycle of the step. Or a function of this environment, called after each step, which returns a number; it may
        read `observation`, `reached_target`, split() and `run`, where it finds what is sensed and what modules need.
    robot: its name in the world; the first one when empty.
    render_mode: "rgb_array", "human" or None.

    Other options: cycles_per_step=5, max_steps=1000 (0: endless), end_at_target=True, speed=(1.0, 1.5) (m/s and rad/s at full
    speed, without a system), seed=1 (until reset() is called with one), settings, plugins, noise, real_time_factor as in
    forage.open(), and paths=False: whether the run keeps the paths of its robots, for env.run.plot("trajectory"). Raises InputError.
    """

    metadata = {"render_modes": _render_modes, "render_fps": 5}

    def __init__(
        self,
        world: _Path,
        system: _Path | None = None,
        *,
        sensors: _Ports = None,
        motors: _Ports = None,
        reward: typing.Any = None,
        robot: str = "",
        render_mode: str | None = None,
        **options: typing.Any,
    ) -> None:
        self._made = _arguments(dict(locals()))
        task = _task(world, system, [_agent(robot, system, sensors, motors, reward)], options)
        self._open(task, render_mode)
        self._reward = reward if callable(reward) else None
        self.sensors = self._use.sensors(0)
        self.observation_space = _observation_space(self.sensors)
        self.action_space = _action_space(self._use.motors(0), options.get("action", "cell"))
        self.observation = self._use.observation(0)
        """What the robot has sensed by the end of the last step, for functions of the reward."""
        self.reached_target = False
        """Whether the robot has reached a target in the last step, for functions of the reward."""

    def reset(self, *, seed: int | None = None, options: _Info | None = None) -> tuple[_Observation, _Info]:
        """Begins an episode, and returns (observation, info).

        With a seed, the run is restarted, and the same actions give the same bits. Without one, the brain keeps what it has
        learned, and the robot starts at the next start pose. options={"start": (x, y, yaw)}, in m and rad, places it there.

        Raises InputError for other options, and for a pose that is out of bounds, where something is, or where a trial ends
        at once; the next reset() begins an episode.
        """
        seed = _seed(seed)
        super().reset(seed=seed)
        self._use.reset(seed, _starts(options, self._use.robots))
        self.observation, self.reached_target = self._use.observation(0), False
        if self.render_mode == "human":
            self.render()
        return self.observation, {"reached_target": False}

    def step(self, action: numpy.typing.ArrayLike) -> tuple[_Observation, float, bool, bool, _Info]:
        """Runs a step, and returns (observation, reward, terminated, truncated, info).

        Raises InputError for an action that is not in the action space, and RunError when the episode has ended.
        """
        self.observation, reward, terminated, truncated, self.reached_target = self._use.step_with(action)
        if self._reward is not None:
            reward = _number(self._reward(self))
        if self.render_mode == "human":
            self.render()
        return self.observation, reward, terminated, truncated, {"reached_target": self.reached_target}


class BugParallelEnv(_Rendered, ParallelEnv):  # type: ignore[misc]
    """The robots of a world, each with an agent, as a parallel environment of PettingZoo.

    The agents have the names of the robots. The options are those of BugEnv; with a system, sensors, motors and rewards are
    dictionaries by robot, and only the robots in `sensors` have agents. A function for the reward gets this environment and
    the robot's name. An agent whose episode has ended is no longer in `agents`; its robot stands until reset().
    """

    metadata = {"render_modes": _render_modes, "render_fps": 5, "name": "forage_bug_v0", "is_parallelizable": True}

    def __init__(
        self,
        world: _Path,
        system: _Path | None = None,
        *,
        sensors: _Ports = None,
        motors: _Ports = None,
        reward: typing.Any = None,
        render_mode: str | None = None,
        **options: typing.Any,
    ) -> None:
        self._made = _arguments(dict(locals()))

        def of(what: typing.Any, robot: str) -> typing.Any:
            return what[robot] if isinstance(what, dict) else what

        if system is None:
            agents = [_agent("", system, sensors, motors, reward)]
        elif isinstance(sensors, dict) and isinstance(motors, dict):
            agents = [_agent(robot, system, sensors[robot], of(motors, robot), of(reward, robot)) for robot in sensors]
        else:
            raise InputError("with a system, sensors and motors are dictionaries of the groups of each robot")
        self._open(_task(world, system, agents, options, every_robot=system is None), render_mode)
        self._reward = reward if callable(reward) else None
        self.possible_agents = self._use.robots
        self._numbers = {name: i for i, name in enumerate(self.possible_agents)}
        self.agents: list[str] = []
        self.observation_spaces = {n: _observation_space(self._use.sensors(i)) for n, i in self._numbers.items()}
        action = options.get("action", "cell")
        self.action_spaces = {n: _action_space(self._use.motors(i), action) for n, i in self._numbers.items()}

    def observation_space(self, agent: str) -> typing.Any:
        return self._of(self.observation_spaces, agent)

    def action_space(self, agent: str) -> typing.Any:
        return self._of(self.action_spaces, agent)

    def _of(self, spaces: dict[str, typing.Any], agent: str) -> typing.Any:
        if agent not in self.possible_agents:
            raise InputError(f"there is no agent {agent!r}; there are {', '.join(self.possible_agents)}")
        return spaces[agent]

    def reset(self, seed: int | None = None, options: _Info | None = None) -> tuple[_Robots, _Robots]:
        """Begins an episode of all agents, and returns (observations, infos), as BugEnv does.

        options={"start": {robot: (x, y, yaw), ...}} places the robots, which must not overlap.
        """
        self._use.reset(_seed(seed), _starts(options, self.possible_agents))
        self.agents = list(self.possible_agents)
        if self.render_mode == "human":
            self.render()
        return ({n: self._use.observation(i) for n, i in self._numbers.items()}, {n: {"reached_target": False} for n in self.agents})

    def step(self, actions: _Robots) -> tuple[_Robots, _Robots, _Robots, _Robots, _Robots]:
        """Runs a step with the actions of all agents, and returns (observations, rewards, terminations, truncations, infos)."""
        run = self._use
        missing, unknown = set(self.agents) - set(actions), set(actions) - set(self.possible_agents)
        if missing:
            raise InputError(f"no action for {', '.join(sorted(missing))}")
        if unknown:
            raise InputError(f"there is no agent {', '.join(sorted(map(str, unknown)))}")
        for name in self.agents:
            run.act(self._numbers[name], actions[name])
        run.step()
        parts = {name: run.outcome(self._numbers[name]) for name in self.agents}
        observations, rewards, terminations, truncations = ({n: p[k] for n, p in parts.items()} for k in range(4))
        infos = {n: {"reached_target": p[4]} for n, p in parts.items()}
        try:
            if self._reward is not None:
                rewards = {n: _number(self._reward(self, n)) for n in parts}
        finally:  # the robots have moved, also when the function of the reward raises
            self.agents = [n for n, p in parts.items() if not (p[2] or p[3])]
        if self.render_mode == "human":
            self.render()
        return observations, rewards, terminations, truncations, infos


class _One(_Sensing):
    """One of the environments of a BugVectorEnv: what the function of a reward, call() and get_attr() see."""

    def __init__(self, several: BugVectorEnv, number: int) -> None:
        self._several, self._number = several, number
        self.sensors = several.sensors
        self.reached_target = False

    @property
    def observation(self) -> _Observation:
        """As that of BugEnv."""
        row: _Observation = self._several.observations[self._number]
        return row

    @property
    def run(self) -> _forage.Run:
        """As that of BugEnv."""
        return self._several._use.run(self._number)

    def render(self) -> typing.Any:
        """A picture, as that of BugEnv."""
        return self._several._use.picture(self._number)


class BugVectorEnv(_Kept, VectorEnv):  # type: ignore[misc]
    """Worlds side by side, one robot each, as a vector environment of Gymnasium.

    All of a step runs on `threads` threads (0: one per core, where that is faster), without Python. The options are those of
    BugEnv. A function for the reward is called for each environment, with one of `envs`: it has observation, reached_target, split() and run
    as a BugEnv has them. Environment i has the seed of environment 0 plus i. An environment whose episode has ended begins the
    next one in the step that follows (Gymnasium calls this NEXT_STEP); its action is then ignored, and its reward is 0.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 5, "autoreset_mode": _next_step}
    _uses = "_pool"
    _pool: _forage.AgentPool | None = None

    def __init__(
        self,
        num_envs: int,
        world: _Path,
        system: _Path | None = None,
        *,
        sensors: _Ports = None,
        motors: _Ports = None,
        reward: typing.Any = None,
        robot: str = "",
        threads: int = 0,
        render_mode: str | None = None,
        **options: typing.Any,
    ) -> None:
        self._made = _arguments(dict(locals()))
        if render_mode not in (None, "rgb_array"):
            raise InputError(f"{render_mode!r} is not a way to render worlds side by side; there is rgb_array, and None")
        task = _task(world, system, [_agent(robot, system, sensors, motors, reward)], options)
        self.num_envs = num_envs
        self.render_mode = render_mode
        self._reward = reward if callable(reward) else None
        self._pool = _forage.AgentPool(num_envs, threads, **task)
        self.sensors = self._pool.sensors()
        self.single_observation_space = _observation_space(self.sensors)
        self.single_action_space = _action_space(self._pool.motors(), options.get("action", "cell"))
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observations = numpy.zeros(self.observation_space.shape, numpy.float32)
        """What the robots have sensed by the end of the last step: a row per environment."""
        self.envs = tuple(_One(self, i) for i in range(num_envs))
        """The environments, each with observation, run, split() and render() as a BugEnv has them."""
        self._ended: _Flags = numpy.zeros(num_envs, bool)

    def __getstate__(self) -> dict[str, typing.Any]:
        return {**super().__getstate__(), "envs": [{name: value for name, value in vars(one).items() if name != "_several"} for one in self.envs]}

    def __setstate__(self, kept: dict[str, typing.Any]) -> None:
        super().__setstate__(kept)
        for one, attributes in zip(self.envs, kept.get("envs", ())):
            vars(one).update(attributes)

    @property
    def threads(self) -> int:
        """The number of threads that share a step."""
        return self._use.threads

    @property
    def _use(self) -> _forage.AgentPool:
        if self._pool is None:
            raise RunError("this environment is closed")
        return self._pool

    def reset(self, *, seed: typing.Any = None, options: _Info | None = None) -> tuple[_Observation, _Info]:
        """Begins an episode everywhere. `seed` is a number for environment 0, or one number or None per environment.

        options={"start": (x, y, yaw)} places all robots there; an array with a row per environment places each of them. With {"reset_mask": [True,
        False, ...]} only some environments begin an episode. Raises InputError as BugEnv.reset() does; some of the environments may have begun an
        episode then.
        """
        count = self.num_envs
        seeds: list[int | None] = []
        if seed is not None and numpy.ndim(seed) == 0:
            seeds = [_seed(operator.index(seed) + i) for i in range(count)]
        elif seed is not None:
            seeds = [_seed(s) for s in seed]
        if seeds and len(seeds) != count:
            raise InputError(f"{len(seeds)} seeds for {count} environments")
        start, mask = _option(options, "start", "reset_mask")
        starts = [] if start is None else [_pose(s) for s in start] if numpy.ndim(start) == 2 else [_pose(start)] * count
        chosen = numpy.ones(count, bool) if mask is None else numpy.asarray(mask)
        if chosen.dtype != bool or chosen.shape != (count,):
            raise InputError(f"reset(): the reset_mask {mask!r} is not {count} times True or False")
        super().reset(seed=seeds[0] if seeds else None)
        self.observations = self._use.reset(seeds, starts, chosen)
        self._ended &= ~chosen
        for one in itertools.compress(self.envs, chosen):
            one.reached_target = False
        return self.observations, {"reached_target": numpy.zeros(count, bool), "_reached_target": chosen}

    def set(self, name: typing.Any, values: typing.Any = None) -> None:
        """Sets a parameter or the weights of a connection everywhere, as BugEnv.set() does: one value for all environments, or one for each.

        env.set("Process/Group.threshold", numpy.linspace(0, 1, env.num_envs)) and env.set("A to B", weights) with weights of shape (targets, sources) or
        (num_envs, targets, sources). Raises InputError, and leaves the values as they were.
        """
        for what, value in _each(name, values):
            if self._use.is_connection(what):
                self._use.set_weights(what, value)
                continue
            each = list(value) if isinstance(value, (list, tuple)) or numpy.ndim(value) else [value] * self.num_envs
            if len(each) != self.num_envs:
                raise InputError(f"set(): {len(each)} values of {what} for {self.num_envs} environments")
            self._use.set_parameters([_assignment(what, v) for v in each])

    def step(self, actions: numpy.typing.ArrayLike) -> tuple[_Observation, numpy.typing.NDArray[numpy.float64], _Flags, _Flags, _Info]:
        """Runs a step everywhere. All parts of what it returns have one row per environment.

        Raises InputError, before any environment steps, for an action that is not in the action space.
        """
        self.observations, rewards, terminated, truncated, reached = self._use.step(actions)
        begun, self._ended = self._ended, terminated | truncated  # also when the function of the reward raises
        if self._reward is not None:
            for one, there in zip(self.envs, reached):
                one.reached_target = bool(there)
            rewards[:] = [0.0 if first else _number(self._reward(one)) for one, first in zip(self.envs, begun)]
        return self.observations, rewards, terminated, truncated, {"reached_target": reached, "_reached_target": numpy.ones(self.num_envs, bool)}

    def render(self) -> tuple[typing.Any, ...] | None:
        """The pictures of all environments, with render_mode="rgb_array"; None without it."""
        return None if self.render_mode is None else self.call("render")

    def call(self, name: str, *arguments: typing.Any, **named: typing.Any) -> tuple[typing.Any, ...]:
        """Calls the method with this name of each of `envs`, and returns the results; an attribute that is no method is its own result."""
        found = [getattr(one, name) for one in self.envs]
        return tuple(f(*arguments, **named) if callable(f) else f for f in found)

    def get_attr(self, name: str) -> tuple[typing.Any, ...]:
        """The attribute with this name of each of `envs`, as in env.get_attr("run")."""
        return tuple(getattr(one, name) for one in self.envs)

    def set_attr(self, name: str, values: typing.Any) -> None:
        """Sets an attribute of each of `envs`, for functions of the reward: a list or tuple has one value for each, anything else is the value of all."""
        each = list(values) if isinstance(values, (list, tuple)) else [values] * self.num_envs
        if len(each) != self.num_envs:
            raise InputError(f"set_attr(): {len(each)} values of {name} for {self.num_envs} environments")
        for one, value in zip(self.envs, each):
            setattr(one, name, value)

    def close_extras(self, **options: typing.Any) -> None:
        self._pool = None
