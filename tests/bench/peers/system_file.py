"""The system file (.iqr) of a case."""
from cases import PROBABILITY


def system_file(case):
    groups = "\n".join(map(group_element, case.groups))
    connections = "\n".join(connection_element(i, c) for i, c in enumerate(case.connections))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="{case.name}">
  <Process id="p" name="P">
{groups}
  </Process>
{connections}
</System>
"""


def group_element(group):
    neuron = (f'<Neuron name="neuronRandomSpike"><Parameter name="probability" value="{PROBABILITY}"/></Neuron>'
              if group.spikes else
              f'<Neuron name="neuronLinearThreshold"><Parameter name="vmPrs" value="{group.kept}"/></Neuron>')
    return f"""    <Group id="{group.name}" name="{group.name}">
      <Topology><TopologyRect hcount="{group.width}" vcount="{group.height}"/></Topology>
      {neuron}
    </Group>"""


def connection_element(number, connection):
    c = connection
    parts = []
    if c.window == 0:
        parts.append("<Pattern><PatternForeach/></Pattern>")
    if c.window > 1:
        parts.append(f'<Arborization><ArbRect width="{c.window}" height="{c.window}" direction="RF" '
                     'initialization_probability="1"/></Arborization>')
    if c.sigma:
        parts.append(f'<AttenuationFunction><FunGaussian min="0" max="1" sigma="{c.sigma}"/></AttenuationFunction>')
    if c.attenuated:
        parts.append(f'<AttenuationFunction><FunRandom max="{c.attenuated}"/></AttenuationFunction>')
    if c.learning_rate:
        parts.append(f'<Synapse name="synapseHebbian"><Parameter name="lrate" value="{c.learning_rate}"/>'
                     '<XRefHolder name="Freedback"><XRef target="act" name="postact"/></XRefHolder></Synapse>')
    else:
        parts.append(f'<Synapse name="synapseFixedWeight"><Parameter name="weight" value="{c.weight}"/></Synapse>')
    body = "\n".join("    " + p for p in parts)
    return f"""  <Connection id="c{number:03}" name="c{number:03}" source="{c.source}" target="{c.target}">
{body}
  </Connection>"""
