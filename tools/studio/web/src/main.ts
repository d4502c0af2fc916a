import { mount } from 'svelte';
import './app.css';
import App from './App.svelte';
import { start } from './studio';
import { kinds } from './panels/registry';
import { frame } from './stores/frame.svelte';

// What every arrangement needs is fetched while the page begins.
void import('dockview-core');
void kinds.diagram!.load();
frame.start();
mount(App, { target: document.getElementById('app')! });
start();
