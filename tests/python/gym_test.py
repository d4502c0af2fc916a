"""Environments for learning agents: the contracts of Gymnasium and PettingZoo, and that they act and sense as brains do."""
import copy
import inspect
import json
import os
import pickle
import signal
import subprocess
import sys
import threading

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import forage
from conftest import SYSTEMS, WORLD
from forage.gym import BugEnv, BugParallelEnv, BugVectorEnv, save_rollouts

DAC = SYSTEMS / "dac_foraging.iqr"
TWO = SYSTEMS / "worlds/two_bugs.world"
GROUPS = {"sensors": ["Bug/Light", "Bug/Sensor"], "motors": ["Bug/Motor"]}
AHEAD = 1  # of the usual 3 x 3 motor cells


def episode(env, seed, steps=60):
    """What an environment returns for actions drawn with the seed."""
    env.action_space.seed(seed)
    out = [env.reset(seed=seed)]
    for _ in range(steps):
        out.append(env.step(env.action_space.sample()))
        if out[-1][2] or out[-1][3]:
            out.append(env.reset())
    return out


def same(a, b):
    return all(numpy.array_equal(x, y) for one, other in zip(a, b) for x, y in zip(one, other))


ENVIRONMENTS = [
    dict(),
    dict(action="velocity", motors={"motor": (9, 9)}),
    dict(action="activity", cycles_per_step=1),
    dict(sensors={"target": None, "placeCell": (5, 7), "gps": None}, max_steps=20),
    dict(system=DAC, **GROUPS),
]


@pytest.mark.parametrize("options", ENVIRONMENTS, ids=lambda o: "-".join(o) or "usual")
def test_the_contract_of_an_environment(options):
    env = BugEnv(WORLD, **options)
    for step in (first := episode(env, 7)):
        observation, info = step[0], step[-1]
        assert env.observation_space.contains(observation) and observation.dtype == env.observation_space.dtype
        assert isinstance(info, dict)
        if len(step) == 5:
            assert type(step[1]) is float and type(step[2]) is bool and type(step[3]) is bool
    assert same(first, episode(env, 7)) and not same(first, episode(env, 8))
    assert same(first, episode(BugEnv(WORLD, **options), 7))
    assert env.unwrapped is env and env.reset(options={})[1] == {"reached_target": False}
    kept = env.reset(seed=1)[0]
    copy = kept.copy()
    env.step(env.action_space.sample())
    assert (kept == copy).all()
    env.close()
    env.close()
    with pytest.raises(forage.RunError, match="closed"):
        env.step(env.action_space.sample())
    with pytest.raises(forage.RunError, match="closed"):
        env.reset()


def drive(env, action, most=200):
    """Repeats an action until the episode ends. Returns the rewards and the last step."""
    rewards = []
    for _ in range(most):
        step = env.step(action)
        rewards.append(step[1])
        if step[2] or step[3]:
            return rewards, step
    raise AssertionError("the episode does not end")


def test_an_episode_ends_at_the_target_or_at_the_bounds_or_after_too_many_steps():
    env = BugEnv(WORLD, max_steps=300)
    env.reset(seed=1, options={"start": (0, -1, numpy.pi / 2)})
    rewards, last = drive(env, AHEAD)
    assert last[2] and last[4]["reached_target"] and rewards[-1] == 1 and sum(rewards) == 1
    with pytest.raises(forage.RunError, match="reset"):
        env.step(AHEAD)
    env.reset(options={"start": (0, -1, -numpy.pi / 2)})
    rewards, last = drive(env, AHEAD)
    assert last[2] and not last[4]["reached_target"] and sum(rewards) == 0
    env.reset()
    rewards, last = drive(env, 4, 300)
    assert last[3] and not last[2] and len(rewards) == 300
    on = BugEnv(WORLD, end_at_target=False)
    on.reset(options={"start": (0, -1, numpy.pi / 2)})
    rewards, last = drive(on, AHEAD)
    assert last[2] and last[4]["reached_target"] and sum(rewards) == 1 and rewards[-1] == 0


def test_episodes_are_the_trials_of_the_run_and_start_where_they_should():
    env = BugEnv(WORLD, noise=False, sensors=["gps"])
    starts = []
    for _ in range(20):
        x, y, yaw = env.reset()[0]
        starts.append((round(2 * (float(x) - 10)) / 2, round(float(y)) - 10))
        drive(env, AHEAD)
    assert set(starts) == {(-1.5, -2), (0, -2), (1.5, -2)}  # those of the world
    assert len(env.run.trials) == 20
    gps = env.reset(options={"start": (1, -2, 0.5)})[0]
    assert gps == pytest.approx([11, 8, 0.5 + numpy.pi], abs=1e-5)


def test_a_seed_begins_everything_again_whatever_happened_before():
    env = BugEnv(WORLD, DAC, **GROUPS, reward="mean(Bug/Light)", paths=True)
    for seed, steps in [(3, 0), (4, 5), (3, 8)]:
        before = env.run
        before.probe("Bug/Light")
        before.params["Bug/Light.threshold"] = 0.9
        before["Bug/Motor"].set(1)
        for _ in range(steps):
            env.step(4)
        cycle, digest = before.cycle, before.digest()
        fresh = BugEnv(WORLD, DAC, **GROUPS, reward="mean(Bug/Light)", seed=99)
        assert (env.reset(seed=seed)[0] == fresh.reset(seed=seed)[0]).all()
        for _ in range(2):
            assert env.run.digest() == fresh.run.digest() and len(env.run.trials) == len(fresh.run.trials)
            for one in (env, fresh):
                for _ in range(30):
                    one.step(40)
        assert not env.run.probes and env.run.plot("trajectory")
        assert (before.cycle, before.digest()) == (cycle, digest) and len(before.probes) == 1


@pytest.mark.parametrize(
    "start, why",
    [
        ((numpy.nan, 0, 0), "finite"),
        ((0, 0, numpy.inf), "finite"),
        ((1e308, 0, 0), "10 km"),
        ((2.6, 0, 0), "out of bounds"),
        ((0, 2.5, 0), "ends at once"),
        ((0, 0), "not a pose"),
        ((0, 0, 0, 0), "not a pose"),
        (("a", 0, 0), "not a pose"),
        ("abc", "not a pose"),
        (5, "not a pose"),
    ],
)
def test_a_pose_at_which_no_robot_can_start_is_an_error(start, why):
    env = BugEnv(WORLD, sensors=["gps"])
    env.reset(seed=1)
    with pytest.raises(forage.InputError, match=why):
        env.reset(options={"start": start})
    with pytest.raises(forage.InputError, match=why):
        env.reset(seed=2, options={"start": start})
    assert env.reset(seed=1)[0] == pytest.approx(BugEnv(WORLD, sensors=["gps"]).reset(seed=1)[0])
    several = BugVectorEnv(2, WORLD, sensors=["gps"])
    with pytest.raises(ValueError, match=why):
        several.reset(options={"start": start})
    several.reset()


def test_robots_do_not_start_in_each_other_and_options_are_known():
    env = BugParallelEnv(TWO, sensors=["gps"])
    apart = {"Scout": (0, 0, 0), "Follower": (1, 0, 0)}
    assert env.reset(options={"start": apart})[0]["Follower"][0] == pytest.approx(11, abs=1e-3)
    swapped = env.reset(options={"start": {"Scout": (1, 0, 0), "Follower": (0, 0, 0)}})[0]
    assert [swapped[name][0] for name in ("Scout", "Follower")] == pytest.approx([11, 10], abs=1e-3)
    for start, why in [
        ({"Scout": (0, 0, 0), "Follower": (0, 0, 1)}, "something is already"),
        ({"Scout": (0, 0, 0)}, "one for each of Scout, Follower"),
        ({"Scuot": (0, 0, 0), "Follower": (1, 0, 0)}, "one for each of Scout, Follower"),
        ((0, 0, 0), "1 start poses for 2 agents"),
    ]:
        with pytest.raises(forage.InputError, match=why):
            env.reset(options={"start": start})
    with pytest.raises(forage.InputError, match="something is already at the start pose .-3, -1"):
        BugEnv(TWO).reset(options={"start": (-3, -1, 0)})  # where the Follower stands
    with pytest.raises(forage.InputError, match="the options 'start' are no dictionary"):
        env.reset(options="start")
    with pytest.raises(forage.InputError, match="unknown options begin"):
        env.reset(options={"begin": apart})
    with pytest.raises(forage.InputError, match="no agent Scuot"):
        env.step({"Scout": 1, "Follower": 1, "Scuot": 1})
    for one in (BugEnv(WORLD), BugVectorEnv(2, WORLD)):
        with pytest.raises(forage.InputError, match="unknown options Start"):
            one.reset(options={"Start": (0, 0, 0)})


def test_worlds_side_by_side_start_where_they_should():
    env = BugVectorEnv(2, WORLD, sensors=["gps"], noise=False)
    assert env.reset(seed=1, options={"start": (1, -1, 0)})[0][:, :2] == pytest.approx(numpy.array([[11, 9]] * 2), abs=1e-3)
    rows = env.reset(options={"start": [(1, -1, 0), (0, 1, 0)]})[0]
    assert rows[:, :2] == pytest.approx(numpy.array([[11, 9], [10, 11]]), abs=1e-3)
    with pytest.raises(forage.InputError, match="3 start poses for 2"):
        env.reset(options={"start": [(1, -1, 0)] * 3})


@pytest.mark.parametrize(
    "kind, wrong",
    [
        ("cell", [-1, 9, 1.5, numpy.nan, "1", None, numpy.inf]),
        ("velocity", [[1.01, 0], [0, -1.01], [0, numpy.nan], ["1", "0"]]),
        ("activity", [[-0.1] + [0] * 8, [1.1] + [0] * 8, [numpy.nan] * 9]),
    ],
)
def test_an_action_outside_its_space_is_an_error(kind, wrong):
    env, several = BugEnv(WORLD, action=kind), BugVectorEnv(2, WORLD, action=kind)
    env.reset(seed=1), several.reset(seed=1)
    for action in wrong:
        with pytest.raises(forage.InputError, match="action"):
            env.step(action)
        with pytest.raises(forage.InputError, match="action"):
            several.step([env.action_space.sample(), action] if kind == "cell" else numpy.array([action, action]))
    assert env.run.cycle == BugEnv(WORLD).run.cycle  # none of them has begun a step
    env.step(env.action_space.high if kind != "cell" else 8)


def test_a_forked_process_steps_worlds_side_by_side():
    env = BugVectorEnv(4, WORLD, threads=2)
    env.reset(seed=1)
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        os._exit(env.step(numpy.ones(4, int))[0].shape != (4, 32))
    assert os.waitpid(child, 0)[1] == 0
    env.step(numpy.ones(4, int))


def test_the_paths_of_the_robot_are_kept_when_wanted():
    with pytest.raises(forage.InputError, match="open it with the option paths"):
        BugEnv(WORLD).run.plot("trajectory")
    env = BugEnv(WORLD, paths=True, max_steps=4)
    drawn = []
    for seed in (1, None, 1):  # a seed begins a new run, whose first trial is the same
        env.reset(seed=seed)
        for _ in range(4):
            env.step(1)
        drawn.append(env.run.plot("trajectory").data)
    assert drawn[0] == drawn[2] != drawn[1]


def test_actions_move_the_robot_as_cells_velocities_and_activities():
    def moved(step, **options):
        env = BugEnv(WORLD, noise=False, sensors=["gps"], cycles_per_step=10, **options)
        x, y, yaw = env.reset(options={"start": (0, 0, 0)})[0].astype(float)
        after = env.step(step)[0]
        return numpy.sign(numpy.round([after[0] - x, after[2] - yaw], 3)).tolist()

    assert moved(1) == [1, 0] and moved(7) == [-1, 0] and moved(0) == [1, 1] and moved(2) == [1, -1]
    velocity = dict(action="velocity", motors={"motor": (9, 9)})
    assert moved([1, 0], **velocity)[0] == 1 and moved([-1, 0], **velocity)[0] == -1
    assert moved([0, 1], **velocity)[1] == 1 and moved([0, -1], **velocity)[1] == -1
    cells = numpy.zeros(9)
    cells[1] = 0.5
    assert moved(cells, action="activity")[0] == 1


def test_observations_are_what_groups_of_the_run_hold():
    env = BugEnv(WORLD, DAC, reward="mean(Bug/Light)", **GROUPS)
    env.reset(seed=2)
    for _ in range(30):
        observation, reward, ended, *_ = env.step(4)  # straight ahead
        if ended:
            break
        parts = env.split(observation)
        assert set(parts) == set(GROUPS["sensors"])
        for name, part in parts.items():
            assert (part == env.run.read(name).astype(numpy.float32)).all()
        assert reward == env.run.read("mean(Bug/Light)")
        assert env.run.read("Bug/Motor").sum() == 1
    with pytest.raises(forage.InputError, match="not computed"):
        env.run["Adaptive/Discrepancy" if "Adaptive/Discrepancy" in env.run else env.run.groups[0]].clamp(1)


def test_an_environment_has_the_bits_of_a_run_whose_motors_are_clamped():
    one, other = (BugEnv(WORLD, DAC, cycles_per_step=4, **GROUPS) for _ in range(2))
    one.reset(seed=5)
    other.reset(seed=5)
    for action in (4, 4, 13, 22, 4, 5, 3) * 5:
        one.step(action)
        pattern = numpy.zeros(81)
        pattern[action] = 1
        with other.run["Bug/Motor"].clamp(pattern.reshape(9, 9)):
            other.run.run(cycles=4)
    assert one.run.cycle == 3 + 4 * 35 and one.run.digest() == other.run.digest()


def test_the_brain_keeps_what_it_has_learned_until_a_seed_is_given():
    env = BugEnv(WORLD, DAC, **GROUPS)
    env.reset(seed=1)
    drive(env, 4)
    cycle = env.run.cycle
    env.reset()
    assert env.run.cycle == cycle + 3
    env.reset(seed=1)
    assert env.run.cycle == 3


def test_a_function_of_the_environment_is_a_reward():
    env = BugEnv(WORLD, reward=lambda e: float(e.observation.max()))
    env.reset(seed=1)
    observation, reward, *_ = env.step(AHEAD)
    assert reward == observation.max()

    def broken(e):
        raise KeyError("light")

    env = BugEnv(WORLD, reward=broken)
    with pytest.raises(KeyError, match="light"):
        env.step(AHEAD)
    env.reset()


@pytest.mark.parametrize("action", [-1, 9, 1.5e9, numpy.nan, [0, 1], "left", None])
def test_what_is_no_action_is_refused_and_the_environment_goes_on(action):
    env = BugEnv(WORLD)
    env.reset(seed=1)
    with pytest.raises((forage.InputError, TypeError, ValueError)):
        env.step(action)
    env.step(AHEAD)


@pytest.mark.parametrize(
    "options, message",
    [
        (dict(sensors=["tarket"]), "did you mean 'target'"),
        (dict(sensors=[]), "senses nothing"),
        (dict(motors=[]), "moves nothing"),
        (dict(motors={"motor": (4, 4)}), "4 x 4"),
        (dict(robot="Bgu"), "Bgu"),
        (dict(cycles_per_step=0), "at least 1 cycle"),
        (dict(action="joystick"), "velocity"),
        (dict(reward="Bug/target"), "is 32 numbers"),
        (dict(reward=1.5), "reward 1.5 is neither a source"),
        (dict(speed=(1e300, 1.5)), "transSpeed is more than 1000"),
        (dict(speed=(1.0, -1e38)), "rotSpeed is more than 1000"),
        (dict(end_at_target=2), "end_at_target is True or False, not 2"),
        (dict(noise=None), "noise is True or False, not None"),
        (dict(render_mode="smell"), "rgb_array"),
        (dict(system=DAC), "name its sensor and motor groups"),
        (dict(system=DAC, sensors=["Bug/Lihgt"], motors=["Bug/Motor"]), "did you mean 'Bug/Light'"),
        (dict(system=DAC, sensors=["Bug/Light"], motors=["Bug/Lihgt"]), "Bug/Lihgt"),
        (dict(system=DAC, sensors=["Bug/Light"], motors=["Bug/Light"], action="velocity"), "cannot take a velocity"),
    ],
)
def test_mistakes_are_told_when_the_environment_is_made(options, message):
    with pytest.raises(forage.InputError, match=message):
        BugEnv(WORLD, **options)


@pytest.mark.parametrize("size", [(0, 3), (-1, 3), (3, 0)])
def test_a_size_of_no_cells_is_an_error(size):
    with pytest.raises(forage.InputError, match="cannot have the size"):
        BugEnv(WORLD, motors={"motor": size})


def test_an_unknown_option_and_a_missing_world_are_told():
    with pytest.raises(TypeError, match="steps_per_cycle"):
        BugEnv(WORLD, steps_per_cycle=3)
    with pytest.raises(forage.InputError, match="nowhere.world"):
        BugEnv("nowhere.world")


def test_pictures_show_the_world_and_change_with_it():
    env = BugEnv(WORLD, render_mode="rgb_array")
    env.reset(seed=1)
    before = env.render()
    assert before.dtype == numpy.uint8 and before.ndim == 3 and before.shape[2] == 3
    for _ in range(10):
        env.step(AHEAD)
    assert (env.render() != before).any()
    env.reset(seed=1)
    assert (env.render() == before).all()
    assert BugEnv(WORLD).render() is None


def test_the_parallel_contract():
    env = BugParallelEnv(TWO, sensors=["proximity", "target"], max_steps=30)
    assert env.possible_agents == ["Scout", "Follower"] and env.max_num_agents == 2

    def play(seed):
        out = [env.reset(seed=seed)]
        for a in env.possible_agents:
            env.action_space(a).seed(seed)
        while env.agents:
            before = list(env.agents)
            out.append(env.step({a: env.action_space(a).sample() for a in env.agents}))
            assert all(set(part) == set(before) for part in out[-1])
            assert all(env.observation_space(a).contains(out[-1][0][a]) for a in before)
            gone = {a for a in before if out[-1][2][a] or out[-1][3][a]}
            assert set(env.agents) == set(before) - gone and env.num_agents == len(env.agents)
        return out

    first, again, other = play(3), play(3), play(4)

    def numbers(all_steps):
        return [
            [x for part in step for a in sorted(part) for x in numpy.ravel(list(part[a].values()) if isinstance(part[a], dict) else part[a])]
            for step in all_steps
        ]

    assert numbers(first) == numbers(again) != numbers(other)
    env.reset()
    with pytest.raises(forage.InputError, match="no action for Follower"):
        env.step({"Scout": 1})
    env.close()
    env.close()


def test_agents_of_one_run_are_rewarded_and_end_on_their_own():
    env = BugParallelEnv(TWO, sensors=["gps"], reward=lambda e, robot: len(robot), max_steps=0)
    env.reset(seed=1)
    rewards = env.step({a: 4 for a in env.agents})[1]
    assert rewards == {"Scout": 5.0, "Follower": 8.0}


def test_agents_end_also_when_the_function_of_the_reward_raises():
    def reward(env, robot):
        raise KeyError(robot)

    env = BugParallelEnv(TWO, sensors=["gps"], reward=reward, max_steps=1)
    env.reset(seed=1)
    with pytest.raises(KeyError):
        env.step(dict.fromkeys(env.agents, 1))
    assert env.agents == []


def test_worlds_side_by_side_have_the_numbers_of_single_ones_on_any_number_of_threads():
    def play(threads):
        env = BugVectorEnv(5, WORLD, sensors=["target", "gps"], max_steps=25, threads=threads)
        assert 1 <= env.threads <= 5 if threads == 0 else env.threads == min(threads, 5)  # 0: one per core
        out = [env.reset(seed=11)]
        assert env.observation_space.contains(out[0][0])
        for step in range(60):
            out.append(env.step((numpy.arange(5) + step // 10) % 9))
        env.close()
        env.close()
        assert env.closed
        return out

    one, three, usual = play(1), play(3), play(0)
    for a, b in [*zip(one, three), *zip(one, usual)]:
        assert same([a[:-1]], [b[:-1]]) and (a[-1]["reached_target"] == b[-1]["reached_target"]).all()
    for i in range(5):
        env = BugEnv(WORLD, sensors=["target", "gps"], max_steps=25)
        assert (env.reset(seed=11 + i)[0] == one[0][0][i]).all()
        ended = False
        for step in range(60):
            if ended:
                expected, ended = (env.reset()[0], 0.0, False, False), False
            else:
                expected = env.step((i + step // 10) % 9)
                ended = expected[2] or expected[3]
            for mine, theirs in zip(expected[:4], one[step + 1][:4]):
                assert numpy.array_equal(mine, theirs[i])


def test_mistakes_with_worlds_side_by_side():
    env = BugVectorEnv(3, WORLD)
    with pytest.raises(forage.InputError, match="2 seeds for 3"):
        env.reset(seed=[1, 2])
    env.reset(seed=[1, 2, 3])
    with pytest.raises(forage.InputError, match="3 numbers, not 2"):
        env.step([1, 2])
    with pytest.raises(forage.InputError, match="no action"):
        env.step([1, 2, 9])
    with pytest.raises(TypeError):
        BugVectorEnv(2, WORLD, reward=len).step([1, 2])
    several = BugVectorEnv(2, WORLD, reward=lambda env: 1 // 0, max_steps=1)
    several.reset(seed=1)
    with pytest.raises(ZeroDivisionError):
        several.step([4, 4])  # the episodes end
    assert several.step([4, 4])[1].tolist() == [0, 0]  # and the next ones begin, without a call of the function
    with pytest.raises(TypeError, match="the reward is a number"):
        BugVectorEnv(2, WORLD, reward=lambda env: "1").step([1, 2])
    with pytest.raises(forage.InputError, match="'human' is not a way"):
        BugVectorEnv(2, WORLD, render_mode="human")
    with pytest.raises(forage.InputError, match="0 environments"):
        BugVectorEnv(0, WORLD)
    with pytest.raises(forage.InputError, match="1000000000 environments"):
        BugVectorEnv(10**9, WORLD)


def test_an_environment_is_not_used_by_two_threads_at_once():
    env = BugVectorEnv(8, WORLD, cycles_per_step=2000, max_steps=0)
    refused = []

    def step():
        try:
            env.step(numpy.full(8, 4))
        except forage.RunError as e:
            refused.append(str(e))

    threads = [threading.Thread(target=step) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert 0 < len(refused) < 4 and "another thread" in refused[0]


def distance(env):
    """A reward that reads all that a function may read."""
    x, y, _ = env.split(env.observation)["Bug/gps"].ravel()
    return -abs(x) - abs(y) + 10 * env.reached_target + len(env.run.trials)


def test_functions_are_rewards_of_one_world_and_of_many():
    several = BugVectorEnv(3, WORLD, sensors=["target", "gps"], reward=distance, max_steps=15)
    singles = [BugEnv(WORLD, sensors=["target", "gps"], reward=distance, max_steps=15) for _ in range(3)]
    several.reset(seed=4)
    ended = [False] * 3
    for i, env in enumerate(singles):
        env.reset(seed=4 + i)
    for step in range(50):
        rewards = several.step([1, 1, step % 9])[1]
        for i, env in enumerate(singles):
            if ended[i]:
                env.reset()
                assert rewards[i] == 0
                ended[i] = False
            else:
                _, reward, terminated, truncated, _ = env.step([1, 1, step % 9][i])
                assert rewards[i] == reward
                ended[i] = terminated or truncated


def test_worlds_side_by_side_are_reached_by_name():
    env = BugVectorEnv(2, WORLD, sensors=["gps"], render_mode="rgb_array")
    observations, _ = env.reset(seed=1)
    assert all((one == row).all() for one, row in zip(env.get_attr("observation"), observations))
    assert [run.seed for run in env.get_attr("run")] == [1, 2] and env.call("run")[0] is env.envs[0].run
    pictures = env.render()
    single = BugEnv(WORLD, sensors=["gps"], render_mode="rgb_array")
    single.reset(seed=2)
    assert len(pictures) == 2 and (pictures[1] == single.render()).all()
    assert env.call("split", observations[0])[1]["Bug/gps"].size == 3 and BugVectorEnv(2, WORLD).render() is None
    env.set_attr("goal", [1, 2])
    assert env.get_attr("goal") == (1, 2)
    for kept in (copy.copy(env), copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
        assert kept.get_attr("goal") == (1, 2) and kept.envs[0] is not env.envs[0] and kept.envs[0].run is not env.envs[0].run
    env.set_attr("goal", 3)
    assert env.get_attr("goal") == (3, 3)
    with pytest.raises(forage.InputError, match="3 values of goal for 2"):
        env.set_attr("goal", [1, 2, 3])
    with pytest.raises(AttributeError, match="nothing"):
        env.get_attr("nothing")


@pytest.mark.parametrize("options", ENVIRONMENTS, ids=lambda o: "-".join(o) or "usual")
def test_the_rules_of_gymnasiums_checker(options):
    """What gymnasium.utils.env_checker.check_env looks at, where test_the_contract_of_an_environment does not."""
    env = BugEnv(WORLD, **options)
    assert list(inspect.signature(env.reset).parameters) == ["seed", "options"] and inspect.signature(env.reset).parameters["seed"].default is None
    for space in (env.action_space, env.observation_space):
        assert all(space.contains(space.sample()) for _ in range(20))
        if hasattr(space, "low"):
            assert (space.low < space.high).all() and space.low.dtype == space.dtype and space.dtype == numpy.float32
    first = env.reset(seed=123)[0]
    assert env.np_random_seed == 123 and env.np_random.bit_generator.state == numpy.random.default_rng(123).bit_generator.state
    env.reset()
    assert env.np_random_seed == 123
    assert (env.reset(seed=123)[0] == first).all() and env.np_random.bit_generator.state == numpy.random.default_rng(123).bit_generator.state
    env.reset(seed=456)
    assert env.np_random_seed == 456
    action = env.action_space.sample()
    env.reset(seed=1), env.action_space.seed(1)
    one = env.step(action)
    env.reset(seed=1)
    two = env.step(action)
    assert (one[0] == two[0]).all() and one[1:] == two[1:] and numpy.isfinite(one[0]).all() and numpy.isfinite(one[1])
    assert BugEnv.metadata["render_modes"] == ["rgb_array", "human"] and BugEnv.metadata["render_fps"] > 0
    with pytest.raises(forage.InputError, match="not a way to render"):
        BugEnv(WORLD, render_mode="ansi")


def test_the_rules_of_pettingzoos_tests():
    """What pettingzoo.test.parallel_api_test and parallel_seed_test look at, where test_the_parallel_contract does not."""
    env, twin = BugParallelEnv(TWO, max_steps=20), BugParallelEnv(TWO, max_steps=20)
    assert not env.agents and BugParallelEnv.metadata["name"] and all(isinstance(agent, str) for agent in env.possible_agents)
    for agent in env.possible_agents:
        assert env.observation_space(agent) is env.observation_space(agent) and env.action_space(agent) is env.action_space(agent)
    for seed in (42, 43):
        for one in (env, twin):
            for agent in one.possible_agents:
                one.action_space(agent).seed(seed)
        observations, infos = env.reset(seed=seed)
        others = twin.reset(seed=seed)[0]
        assert all((observations[agent] == others[agent]).all() for agent in env.agents)
        assert env.agents == env.possible_agents and set(infos) == set(observations) == set(env.agents)
        gone = set()
        while env.agents:
            actions = {agent: env.action_space(agent).sample() for agent in env.agents}
            assert actions == {agent: twin.action_space(agent).sample() for agent in twin.agents}
            step, other = env.step(actions), twin.step(actions)
            assert all((step[0][agent] == other[0][agent]).all() for agent in step[0]) and step[1:] == other[1:]
            assert not gone & set(step[0])
            gone |= {agent for agent in step[0] if step[2][agent] or step[3][agent]}
            assert all(type(flag) is bool for part in step[2:4] for flag in part.values())
    assert env.num_agents == 0 and gone == set(env.possible_agents)


def test_the_rules_of_vector_environments():
    """What Gymnasium's vector environments promise: batches of the single spaces, and a mask for each key of infos."""
    env = BugVectorEnv(3, WORLD, max_steps=4, end_at_target=False)
    assert env.num_envs == 3 and env.observation_space.shape == (3, *env.single_observation_space.shape) and not env.closed
    assert env.metadata["autoreset_mode"] in ("NextStep", getattr(env.metadata["autoreset_mode"], "NEXT_STEP", None)) and env.np_random_seed is not None
    infos = [env.reset(seed=3)[1]]
    assert env.np_random_seed == 3
    for step in range(6):
        observations, rewards, terminated, truncated, info = env.step(numpy.full(3, 4))  # the robots stand
        assert env.observation_space.contains(observations) and rewards.dtype == numpy.float64
        assert [part.shape for part in (rewards, terminated, truncated)] == [(3,)] * 3 and terminated.dtype == truncated.dtype == bool
        assert truncated.all() == (step == 3)
        infos.append(info)
    for info in infos:
        assert all(name.startswith("_") or info["_" + name].dtype == bool and len(info["_" + name]) == len(info[name]) == 3 for name in info)


@settings(max_examples=15)
@given(st.lists(st.integers(0, 8), min_size=1, max_size=40), st.integers(0, 2**31))
def test_any_actions_give_observations_in_the_space_and_the_same_ones_again(actions, seed):
    def play():
        env = BugEnv(WORLD, sensors=["target", "proximity"])
        out = [env.reset(seed=seed)[0]]
        for a in actions:
            observation, _, terminated, truncated, _ = env.step(a)
            out.append(observation)
            if terminated or truncated:
                out.append(env.reset()[0])
        assert all(env.observation_space.contains(o) for o in out)
        return numpy.array(out)

    assert (play() == play()).all()


def test_the_environments_are_subclasses_where_gymnasium_is_installed(tmp_path):
    (tmp_path / "gymnasium/vector/utils").mkdir(parents=True)
    (tmp_path / "gymnasium/__init__.py").write_text("class Env: pass\nfrom forage import _spaces as spaces\n")
    (tmp_path / "gymnasium/vector/__init__.py").write_text("class VectorEnv: pass\nclass AutoresetMode: NEXT_STEP = 'mode'\n")
    (tmp_path / "gymnasium/vector/utils/__init__.py").write_text("batch_space = None\n")
    (tmp_path / "pettingzoo.py").write_text("class ParallelEnv: pass\n")
    code = (
        "import gymnasium, pettingzoo, forage, sys; assert 'forage.gym' not in sys.modules\nfrom forage.gym import *\n"
        "assert issubclass(BugEnv, gymnasium.Env) and issubclass(BugParallelEnv, pettingzoo.ParallelEnv)\n"
        "assert issubclass(BugVectorEnv, gymnasium.vector.VectorEnv) and BugVectorEnv.metadata['autoreset_mode'] == 'mode'\n"
    )
    path = os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]])
    subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": path}, check=True)


@pytest.mark.parametrize("options", ENVIRONMENTS, ids=lambda o: "-".join(o) or "usual")
def test_the_checker_of_gymnasium_finds_nothing(options):
    checker = pytest.importorskip("gymnasium.utils.env_checker")
    checker.check_env(BugEnv(WORLD, **options), skip_render_check=True)


def test_the_test_of_pettingzoo_finds_nothing():
    tests = pytest.importorskip("pettingzoo.test")
    tests.parallel_api_test(BugParallelEnv(TWO, max_steps=50), num_cycles=200)


def test_rollouts_have_the_layout_of_minari(tmp_path):
    h5py = pytest.importorskip("h5py")
    env = BugEnv(WORLD, max_steps=20)
    file = save_rollouts(tmp_path / "ahead-v0", env, lambda light: AHEAD, episodes=3, seed=5)
    assert file == tmp_path / "ahead-v0/data/main_data.hdf5"
    expected, _ = env.reset(seed=5)
    with h5py.File(file) as data:
        assert list(data) == ["episode_0", "episode_1", "episode_2"]
        first, steps = data["episode_0"], [int(episode.attrs["total_steps"]) for episode in data.values()]
        assert first.attrs["seed"] == 5 and "seed" not in data["episode_1"].attrs and first.attrs["id"] == 0
        assert first["observations"].shape == (steps[0] + 1, 32) and (first["observations"][0] == expected).all()
        assert first["actions"][:].tolist() == [AHEAD] * steps[0] and first["rewards"].shape == (steps[0],)
        assert first["terminations"][-1] != first["truncations"][-1] and not first["terminations"][:-1].any()
    metadata = json.loads((file.parent / "metadata.json").read_text())
    assert (metadata["total_episodes"], metadata["total_steps"], metadata["data_format"]) == (3, sum(steps), "hdf5")
    assert json.loads(metadata["action_space"]) == {"type": "Discrete", "dtype": "int64", "start": 0, "n": 9}
    assert json.loads(metadata["observation_space"])["shape"] == [32]
    with pytest.raises(forage.InputError, match="exists"):
        save_rollouts(tmp_path / "ahead-v0", env, lambda light: AHEAD, episodes=1)
    with pytest.raises(forage.InputError, match="at least one"):
        save_rollouts(tmp_path / "none", env, lambda light: AHEAD, episodes=0)
    with pytest.raises(ZeroDivisionError):
        save_rollouts(tmp_path / "broken", env, lambda light: 1 // 0, episodes=1)
    assert [path.name for path in tmp_path.iterdir()] == ["ahead-v0"]
