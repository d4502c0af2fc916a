// The menu of the system, which the finder lists, too.
import { addFiles, copyLink, downloadSystem } from '../browser/files';
import { inBrowser } from '../browser/socket';
import { dialogs } from '../parts/dialogs.svelte';
import { dock } from '../stores/dock.svelte';
import { model } from '../stores/model.svelte';
import { run } from '../stores/run.svelte';
import { selection } from '../stores/selection.svelte';
import { openText } from '../xml/place.svelte';
import { editing, worldFile } from './document.svelte';
import { examples } from './examples.svelte';
import { backup, fileDialog, quit, save, saveWorld } from './file.svelte';
import type { Entries } from './menu.svelte';
import { partEntries, properties } from './menus';
import { palette } from './palette.svelte';

export function systemMenu(): Entries {
  const process = model.processes.find((p) => p.id === selection.process);
  return [
    { label: 'New…', name: 'New system', words: 'create start begin build robot', keys: 'Alt N', act: () => fileDialog.open('new') },
    { label: 'Open…', name: 'Open a system', words: 'load file', keys: 'Ctrl O', act: () => fileDialog.open('open') },
    { label: 'Open an example…', name: 'Open an example', words: 'demo sample robot load', act: () => examples.open() },
    { label: 'Save', keys: 'Ctrl S', disabled: !editing.dirty && editing.file !== '' && !editing.backupOf, act: save },
    { label: 'Save as…', keys: 'Ctrl Shift S', act: () => fileDialog.open('save as') },
    { label: 'Save a backup', words: 'copy keep', keys: 'Ctrl B', disabled: !editing.file || editing.shipped, act: backup },
    ...(inBrowser
      ? [
        null,
        { label: 'Download', name: 'Download the system', act: downloadSystem },
        { label: 'Add files…', name: 'Add files of this computer', act: addFiles },
        { label: 'Copy a link', name: 'Copy a link to this system', act: copyLink },
      ]
      : []),
    null,
    { label: 'Add a part…', words: 'template library insert', act: () => palette.open([20, 20]) },
    { label: 'Import a process…', act: () => fileDialog.open('import') },
    { label: 'Link a process…', act: () => fileDialog.open('link') },
    { label: 'Export the process…', name: `Export the process ${process?.name}`, disabled: !process, act: () => fileDialog.open('export', process?.id) },
    ...(process ? partEntries(process) : []),
    null,
    { label: 'Changes since the last save', words: 'difference diff', act: () => dock.plot({ kind: 'difference' }) },
    { label: `Problems (${editing.problems.length})`, name: 'Show the problems', act: () => dock.plot({ kind: 'problems' }) },
    { label: 'XML of the system', name: 'Edit the XML of the system', act: () => openText() },
    { label: 'Properties of the system', act: () => properties('system') },
    null,
    { label: 'Another world…', words: 'open arena maze load', act: () => fileDialog.open('world') },
    { label: 'Edit the world', words: 'walls floor light robot', disabled: !model.world, act: () => dock.openWorld() },
    { label: 'Save the world', disabled: !worldFile.dirty, act: saveWorld },
    { label: 'Save the world as…', disabled: !worldFile.document, act: () => fileDialog.open('save the world') },
    null,
    { label: 'Settings…', words: 'preferences options', act: () => (dialogs.shown = 'settings') },
    { label: 'About Forage', words: 'version help', act: () => (dialogs.shown = 'about') },
    ...(run.can('quit') ? [{ label: 'Quit…', act: quit }] : []),
  ];
}
